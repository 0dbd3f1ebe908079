#include "simplify/chord.h"

#include <algorithm>
#include <array>

namespace hexweft {
namespace {

class ChordWalker {
 public:
  explicit ChordWalker(const BaseComplex& bc)
      : bc_(bc), done_(3 * bc.components.size(), 0), seen_(bc.components.size(), -1) {}

  bool done(int component, int axis) const { return done_[3 * component + axis]; }

  Chord walk(int component, int axis) {
    Chord chord;
    ChordLink link{component, axis};
    chord.closed = !walk_end(link, 1, chord);
    if (!chord.closed) {
      Chord back;
      walk_end({component, axis}, 0, back);
      std::reverse(back.links.begin(), back.links.end());
      back.links.pop_back();
      back.links.insert(back.links.end(), chord.links.begin(), chord.links.end());
      chord.links = std::move(back.links);
    }
    ++stamp_;
    for (const ChordLink& l : chord.links) {
      done_[3 * l.component + l.axis] = 1;
      chord.self_crossing |= seen_[l.component] == stamp_;
      seen_[l.component] = stamp_;
    }
    return chord;
  }

 private:
  // Appends links from `link` on, leaving through its side `end`; false on coming back to the
  // start.
  bool walk_end(ChordLink link, int end, Chord& chord) const {
    const ChordLink start = link;
    while (true) {
      chord.links.push_back(link);
      const Component& c = bc_.components[link.component];
      const int face_id = c.faces[2 * link.axis + end];
      const BaseFace& face = bc_.faces[face_id];
      if (face.boundary()) return true;
      const int next = face.components[face.components[0] == link.component ? 1 : 0];
      int side = 0;
      while (bc_.components[next].faces[side] != face_id ||
             (next == link.component && side == 2 * link.axis + end)) {
        ++side;
      }
      link = follow(link, 2 * link.axis + end, next, side);
      end = 1 - side % 2;
      if (link.component == start.component && link.axis == start.axis) {
        chord.twisted = link.turned != start.turned;
        chord.group_at_end = link.group;
        return false;
      }
    }
  }

  // The base vertices that the four edges along a chord end on at a side.
  std::array<int, 4> ends_on(int component, int side) const {
    const Component& c = bc_.components[component];
    std::array<int, 4> ends;
    for (int i = 0; i < 4; ++i)
      ends[i] = c.corners[kEdgeCorners[4 * side_axis(side) + i][side % 2]];
    return ends;
  }

  // The link that a chord goes on to through a side of the last one, which is a side of the next.
  ChordLink follow(const ChordLink& from, int from_side, int component, int side) const {
    const std::array<int, 4> before = ends_on(from.component, from_side),
                             after = ends_on(component, side);
    ChordLink to{component, side_axis(side)};
    for (int i = 0; i < 4; ++i) {
      const auto same = std::find(before.begin(), before.end(), after[i]);
      to.group[i] = from.group[same - before.begin()];
    }
    to.turned = to.group[0] == 1 || to.group[0] == 2;
    return to;
  }

  const BaseComplex& bc_;
  std::vector<char> done_;  // by component and axis
  std::vector<int> seen_;   // by component: the chord that passed last
  int stamp_ = -1;
};

}  // namespace

std::vector<Chord> extract_chords(const BaseComplex& bc) {
  std::vector<Chord> chords;
  ChordWalker walker(bc);
  for (int c = 0; c < static_cast<int>(bc.components.size()); ++c) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!walker.done(c, axis)) chords.push_back(walker.walk(c, axis));
    }
  }
  return chords;
}

LinkEdges link_edges(const BaseComplex& bc, const ChordLink& link, Diagonal diagonal) {
  const auto& e = bc.components[link.component].edges;
  const int first = 4 * link.axis;
  const bool other = link.turned != (diagonal == Diagonal::second);
  return other ? LinkEdges{e[first + 1], e[first + 2], e[first], e[first + 3]}
               : LinkEdges{e[first], e[first + 3], e[first + 1], e[first + 2]};
}

}  // namespace hexweft
