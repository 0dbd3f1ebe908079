#include "ovm/property.h"

#include <algorithm>
#include <cassert>

namespace hexweft {

void PropertyRegistry::grow(int n) {
  size_ = n;
  for (auto& s : storages_) s->grow(n);
}

void PropertyRegistry::keep(const std::vector<int>& old_of_new) {
  size_ = static_cast<int>(old_of_new.size());
  for (auto& s : storages_) s->keep(old_of_new);
}

void PropertyRegistry::copy_element(int from, int to) {
  for (auto& s : storages_) s->copy_element(from, to);
}

void PropertyRegistry::take_mean(std::span<const int> from, int to) {
  for (auto& s : storages_) s->take_mean(from, to);
}

void PropertyRegistry::open_savepoint() {
  savepoint_sizes_.push_back(size_);
  for (auto& s : storages_) s->journal().open_savepoint();
}

void PropertyRegistry::rollback() {
  size_ = savepoint_sizes_.back();
  savepoint_sizes_.pop_back();
  for (auto& s : storages_) {
    s->journal().rollback();
    s->journal().truncate(size_);  // one born inside the transaction began longer than this
  }
}

void PropertyRegistry::commit() {
  savepoint_sizes_.pop_back();
  for (auto& s : storages_) s->journal().commit();
}

void PropertyRegistry::add(std::shared_ptr<PropertyStorageBase> storage) {
  for (std::size_t i = 0; i < savepoint_sizes_.size(); ++i) storage->journal().open_savepoint();
  storages_.push_back(std::move(storage));
}

void PropertyRegistry::remove_private(const PropertyStorageBase* storage) {
  std::erase_if(storages_, [&](const auto& s) { return s.get() == storage; });
}

std::shared_ptr<PropertyStorageBase> PropertyRegistry::find(const std::string& name) const {
  if (name.empty()) return nullptr;
  for (const auto& s : storages_) {
    if (s->name() == name) return s;
  }
  return nullptr;
}

std::vector<std::shared_ptr<PropertyStorageBase>> PropertyRegistry::named() const {
  std::vector<std::shared_ptr<PropertyStorageBase>> result;
  for (const auto& s : storages_) {
    if (!s->name().empty()) result.push_back(s);
  }
  return result;
}

bool PropertyRegistry::erase(const std::string& name) {
  if (!savepoint_sizes_.empty()) {
    throw InputError("property \"" + name + "\" cannot be erased inside a transaction");
  }
  return std::erase_if(storages_, [&](const auto& s) { return s->name() == name; }) > 0;
}

std::shared_ptr<PropertyRegistry> PropertyRegistry::clone() const {
  assert(savepoint_sizes_.empty());
  auto copy = std::make_shared<PropertyRegistry>();
  copy->size_ = size_;
  for (const auto& s : storages_) {
    if (!s->name().empty()) copy->storages_.push_back(s->clone());
  }
  return copy;
}

}  // namespace hexweft
