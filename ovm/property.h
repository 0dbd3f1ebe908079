/// \file
/// Values on the elements of a mesh that grow, compact, roll back and copy with it.
///
///     CellProperty<int> block(mesh, -1);  // private: lives as long as this object
///     auto weight = named_property<VertexTag, double>(mesh, "weight", 1.0);  // the mesh keeps it
///     block[c] = 3;
///     if (block.get(c) == 3) ...
///
/// A transaction logs what may be written: of a property that is not const, block[c] counts as a
/// write even if it is only read, block.get(c) does not.
///
/// A mesh that is assigned takes over the named properties of the other with its elements; so it is
/// with functions that replace a mesh as a whole. Property objects from before keep the values that
/// they had, but these are the mesh's no more: make private ones anew and fetch named ones again.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <typeinfo>
#include <utility>
#include <vector>

#include "ovm/detail/mean_value.h"
#include "ovm/errors.h"
#include "ovm/handles.h"
#include "ovm/journaled_array.h"

namespace hexweft {

/// The storage of one property, without its type.
class PropertyStorageBase {
 public:
  explicit PropertyStorageBase(std::string name) : name_(std::move(name)) {}
  virtual ~PropertyStorageBase() = default;
  const std::string& name() const { return name_; }  ///< empty for a private property
  virtual const std::type_info& type() const = 0;
  virtual void grow(int n) = 0;                               ///< new elements get the default
  virtual void keep(const std::vector<int>& old_of_new) = 0;  ///< compaction
  virtual void copy_element(int from, int to) = 0;
  /// The mean of reals, what numbers of other kinds have in common; else the default.
  virtual void take_mean(std::span<const int> from, int to) = 0;
  virtual JournaledArrayBase& journal() = 0;
  virtual std::shared_ptr<PropertyStorageBase> clone() const = 0;

 private:
  std::string name_;
};

template <class T>
class PropertyStorage final : public PropertyStorageBase {
 public:
  PropertyStorage(std::string name, int n, T default_value)
      : PropertyStorageBase(std::move(name)),
        default_(std::move(default_value)),
        values_(n, default_) {}
  const std::type_info& type() const override { return typeid(T); }
  void grow(int n) override { values_.resize(n, default_); }
  void keep(const std::vector<int>& old_of_new) override { values_.keep(old_of_new); }
  void copy_element(int from, int to) override { values_.set(to, T(values_[from])); }
  void take_mean(std::span<const int> from, int to) override {
    if constexpr (detail::Numeric<T>) {
      std::vector<T> values;
      for (int i : from) values.push_back(values_[i]);
      values_.set(to, detail::mean_value(values, default_));
    }
  }
  JournaledArrayBase& journal() override { return values_; }
  std::shared_ptr<PropertyStorageBase> clone() const override {
    return std::make_shared<PropertyStorage>(*this);
  }
  const T& default_value() const { return default_; }
  JournaledArray<T>& values() { return values_; }
  const JournaledArray<T>& values() const { return values_; }

 private:
  T default_;
  JournaledArray<T> values_;
};

/// All properties of one kind of element. The mesh owns it; property objects hold on to it so that
/// they may outlive the mesh.
class PropertyRegistry {
 public:
  int size() const { return size_; }
  void grow(int n);
  void keep(const std::vector<int>& old_of_new);
  void copy_element(int from, int to);                ///< every property of `from` to `to`
  void take_mean(std::span<const int> from, int to);  ///< the same for an element amid others
  void open_savepoint();
  void rollback();
  void commit();

  void add(std::shared_ptr<PropertyStorageBase> storage);
  void remove_private(const PropertyStorageBase* storage);
  std::shared_ptr<PropertyStorageBase> find(const std::string& name) const;  ///< null if none
  std::vector<std::shared_ptr<PropertyStorageBase>> named() const;           ///< in order of birth
  /// \return  if there was one
  /// \throws InputError inside a transaction, which could not bring it back
  bool erase(const std::string& name);
  /// The named properties only, each copied.
  std::shared_ptr<PropertyRegistry> clone() const;

 private:
  int size_ = 0;
  std::vector<int> savepoint_sizes_;
  std::vector<std::shared_ptr<PropertyStorageBase>> storages_;
};

class HexMesh;
template <class Tag>
const std::shared_ptr<PropertyRegistry>& property_registry(const HexMesh& mesh);

/// A value of type T on every element of one kind. Copies of the object share the values.
/// Made or destroyed only while no transaction is open that began after (before) it.
template <class Tag, class T>
class Property {
 public:
  Property(const HexMesh& mesh, T default_value = T())
      : registry_(property_registry<Tag>(mesh)),
        storage_(
            std::make_shared<PropertyStorage<T>>("", registry_->size(), std::move(default_value))) {
    registry_->add(storage_);
  }
  Property(std::shared_ptr<PropertyRegistry> registry, std::shared_ptr<PropertyStorage<T>> storage)
      : registry_(std::move(registry)), storage_(std::move(storage)) {}
  Property(const Property&) = default;
  Property(Property&&) noexcept = default;
  Property& operator=(const Property& other) {
    if (this != &other) {
      release();
      registry_ = other.registry_;
      storage_ = other.storage_;
    }
    return *this;
  }
  Property& operator=(Property&& other) noexcept {
    if (this != &other) {
      release();
      registry_ = std::move(other.registry_);
      storage_ = std::move(other.storage_);
    }
    return *this;
  }
  ~Property() { release(); }

  const T& get(Handle<Tag> h) const { return std::as_const(*storage_).values()[h.idx]; }
  const T& operator[](Handle<Tag> h) const { return get(h); }
  T& operator[](Handle<Tag> h) { return storage_->values().at(h.idx); }  ///< counts as a write
  const std::string& name() const { return storage_->name(); }
  int size() const { return storage_->values().size(); }

 private:
  void release() {
    // The registry holds one more reference; the last private object takes the values with it.
    if (storage_ && storage_->name().empty() && storage_.use_count() == 2) {
      registry_->remove_private(storage_.get());
    }
    storage_.reset();
  }
  std::shared_ptr<PropertyRegistry> registry_;
  std::shared_ptr<PropertyStorage<T>> storage_;
};

template <class T>
using VertexProperty = Property<VertexTag, T>;
template <class T>
using EdgeProperty = Property<EdgeTag, T>;
template <class T>
using FaceProperty = Property<FaceTag, T>;
template <class T>
using HalfFaceProperty = Property<HalfFaceTag, T>;
template <class T>
using CellProperty = Property<CellTag, T>;

/// The property of this name, made with the default value if the mesh has none.
/// \throws InputError if the name is taken by a property of another type
template <class Tag, class T>
Property<Tag, T> named_property(const HexMesh& mesh, const std::string& name,
                                T default_value = T()) {
  const auto& registry = property_registry<Tag>(mesh);
  if (auto found = registry->find(name)) {
    auto typed = std::dynamic_pointer_cast<PropertyStorage<T>>(found);
    if (!typed) throw InputError("property \"" + name + "\" exists with another type");
    return {registry, typed};
  }
  auto made =
      std::make_shared<PropertyStorage<T>>(name, registry->size(), std::move(default_value));
  registry->add(made);
  return {registry, made};
}

}  // namespace hexweft
