/// \file
/// Which samples belong to which side, so that those of a few sides are found without looking at all.
#pragma once

#include <vector>

namespace hexweft {

/// A list of samples for every side, and one for -1, no side, in which every sample starts. Moving a
/// sample costs the same whatever their number.
class SampleLists {
 public:
  void resize(int n_sides) {
    if (n_sides >= static_cast<int>(first_.size())) first_.resize(n_sides + 1, -1);
  }
  void add_sample() {
    links_.push_back({-1, -1, -1});
    link(static_cast<int>(links_.size()) - 1, -1);
  }

  int side(int sample) const { return links_[sample].side; }

  /// \param new_side  of an old one that has samples
  template <class F>
  void renumber(int n_sides, F&& new_side) {
    first_.assign(n_sides + 1, -1);
    for (std::size_t s = 0; s < links_.size(); ++s)
      link(static_cast<int>(s), new_side(links_[s].side));
  }

  void move(int sample, int side) {
    if (links_[sample].side == side) return;
    const Link l = links_[sample];
    if (l.before >= 0) {
      links_[l.before].after = l.after;
    } else {
      first_[l.side + 1] = l.after;
    }
    if (l.after >= 0) links_[l.after].before = l.before;
    link(sample, side);
  }

  /// In no particular order. \param f  called with each sample; must not move any
  template <class F>
  void for_each(int side, F&& f) const {
    for (int s = first_[side + 1]; s >= 0; s = links_[s].after) f(s);
  }

 private:
  struct Link {
    int side, before, after;
  };

  void link(int sample, int side) {
    int& first = first_[side + 1];
    links_[sample] = {side, -1, first};
    if (first >= 0) links_[first].before = sample;
    first = sample;
  }

  std::vector<int> first_{-1};  // by side + 1
  std::vector<Link> links_;     // by sample
};

}  // namespace hexweft
