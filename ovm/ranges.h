/// \file
/// The ranges a mesh hands out. All are views: cheap to copy, invalid after an edit.
#pragma once

#include <cstddef>
#include <iterator>

#include "ovm/journaled_array.h"

namespace hexweft {

/// Handles 0 .. n-1 that the mesh says are live.
template <class HandleT, class Mesh>
class LiveRange {
 public:
  class iterator {
   public:
    using value_type = HandleT;
    using difference_type = std::ptrdiff_t;
    using iterator_category = std::forward_iterator_tag;
    using reference = HandleT;
    using pointer = const HandleT*;
    iterator() = default;
    iterator(const Mesh* mesh, int i, int n) : mesh_(mesh), i_(i), n_(n) { skip(); }
    HandleT operator*() const { return HandleT(i_); }
    iterator& operator++() {
      ++i_;
      skip();
      return *this;
    }
    iterator operator++(int) {
      iterator old = *this;
      ++*this;
      return old;
    }
    bool operator==(const iterator& o) const { return i_ == o.i_; }

   private:
    void skip() {
      while (i_ < n_ && !mesh_->is_live(HandleT(i_))) ++i_;
    }
    const Mesh* mesh_ = nullptr;
    int i_ = 0, n_ = 0;
  };
  LiveRange(const Mesh* mesh, int n) : mesh_(mesh), n_(n) {}
  iterator begin() const { return {mesh_, 0, n_}; }
  iterator end() const { return {mesh_, n_, n_}; }

 private:
  const Mesh* mesh_;
  int n_;
};

/// The elements threaded on a singly linked list of slots; slot s belongs to element s / kSlots.
template <class HandleT, int kSlots>
class ListRange {
 public:
  class iterator {
   public:
    using value_type = HandleT;
    using difference_type = std::ptrdiff_t;
    using iterator_category = std::forward_iterator_tag;
    using reference = HandleT;
    using pointer = const HandleT*;
    iterator() = default;
    iterator(const JournaledArray<int>* next, int slot) : next_(next), slot_(slot) {}
    HandleT operator*() const { return HandleT(slot_ / kSlots); }
    int slot() const { return slot_; }  ///< slot() % kSlots: where in the element
    iterator& operator++() {
      slot_ = (*next_)[slot_];
      return *this;
    }
    iterator operator++(int) {
      iterator old = *this;
      ++*this;
      return old;
    }
    bool operator==(const iterator& o) const { return slot_ == o.slot_; }

   private:
    const JournaledArray<int>* next_ = nullptr;
    int slot_ = -1;
  };
  ListRange(const JournaledArray<int>* next, int head) : next_(next), head_(head) {}
  iterator begin() const { return {next_, head_}; }
  iterator end() const { return {next_, -1}; }
  bool empty() const { return head_ < 0; }
  int size() const {  ///< walks the list
    int n = 0;
    for (int s = head_; s >= 0; s = (*next_)[s]) ++n;
    return n;
  }

 private:
  const JournaledArray<int>* next_;
  int head_;
};

}  // namespace hexweft
