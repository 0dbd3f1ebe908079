/// \file
/// A growing array whose changes can be undone at the cost of what was written.
#pragma once

#include <cassert>
#include <cstddef>
#include <utility>
#include <vector>

namespace hexweft {

/// What a transaction needs of an array, whatever its element type.
class JournaledArrayBase {
 public:
  virtual ~JournaledArrayBase() = default;
  virtual void open_savepoint() = 0;  ///< everything from here on can be undone; savepoints nest
  virtual void rollback() = 0;        ///< undoes all since the last open savepoint and closes it
  virtual void commit() = 0;          ///< keeps all since the last open savepoint and closes it
  virtual void truncate(int n) = 0;   ///< drops what lies beyond n, unlogged
};

/// A flat array. While a savepoint is open, every write through set() or at() logs the value it
/// replaces, so that a rollback costs the number of writes, not the size of the array.
template <class T>
class JournaledArray final : public JournaledArrayBase {
 public:
  JournaledArray() = default;
  JournaledArray(std::size_t n, const T& value) : data_(n, Box{value}) {}

  int size() const { return static_cast<int>(data_.size()); }
  const T& operator[](int i) const { return data_[i].value; }

  void set(int i, const T& value) {
    log(i);
    data_[i].value = value;
  }
  /// A reference to write through; the value it has now is logged.
  T& at(int i) {
    log(i);
    return data_[i].value;
  }
  void push_back(const T& value) { data_.push_back(Box{value}); }
  void resize(int n, const T& value) {
    assert(n >= size());
    data_.resize(n, Box{value});
  }
  void reserve(int n) { data_.reserve(n); }

  /// Keeps the elements listed, in this order. \pre no open savepoint
  void keep(const std::vector<int>& old_of_new) {
    assert(savepoints_.empty());
    std::vector<Box> kept;
    kept.reserve(old_of_new.size());
    for (int old : old_of_new) kept.push_back(std::move(data_[old]));
    data_ = std::move(kept);
  }

  void open_savepoint() override { savepoints_.push_back({data_.size(), log_.size()}); }
  void rollback() override {
    const Savepoint s = savepoints_.back();
    savepoints_.pop_back();
    while (log_.size() > s.log_size) {
      data_[log_.back().first].value = std::move(log_.back().second);
      log_.pop_back();
    }
    truncate(static_cast<int>(s.size));
  }
  void truncate(int n) override {
    if (n < size()) data_.erase(data_.begin() + n, data_.end());
  }
  void commit() override {
    savepoints_.pop_back();
    if (savepoints_.empty()) log_.clear();
  }

 private:
  struct Box {  // so that an array of bool has addressable elements
    T value;
  };
  struct Savepoint {
    std::size_t size, log_size;
  };
  void log(int i) {
    if (!savepoints_.empty()) log_.emplace_back(i, data_[i].value);
  }

  std::vector<Box> data_;
  std::vector<std::pair<int, T>> log_;
  std::vector<Savepoint> savepoints_;
};

}  // namespace hexweft
