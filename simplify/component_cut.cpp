#include "simplify/component_cut.h"

#include <array>

namespace hexweft {
namespace {

// One unit may pass each base face, either way.
class Network {
 public:
  Network(const BaseComplex& bc, std::span<const int> inside, std::span<const int> outside)
      : bc_(bc), flow_(bc.faces.size(), 0), is_sink_(bc.components.size(), 0), sources_(inside) {
    for (int c : outside) is_sink_[c] = 1;
  }

  ComponentCut cut() {
    ComponentCut result;
    while (search()) ++result.n_faces;
    result.inside.assign(bc_.components.size(), 0);
    for (int c : reached_) result.inside[c] = 1;
    return result;
  }

 private:
  // Breadth first along what is not saturated; sends a unit if that leads out.
  bool search() {
    reached_.assign(sources_.begin(), sources_.end());
    by_face_.assign(bc_.components.size(), kUnreached);
    for (int c : sources_) by_face_[c] = kSource;
    for (std::size_t next = 0; next < reached_.size(); ++next) {
      const int here = reached_[next];
      for (int f : bc_.components[here].faces) {
        const int there = across(f, here);
        if (there < 0 || by_face_[there] != kUnreached || flow_[f] == outwards(f, here)) continue;
        by_face_[there] = f;
        if (is_sink_[there]) {
          send_back_to_source(there);
          return true;
        }
        reached_.push_back(there);
      }
    }
    return false;
  }

  void send_back_to_source(int c) {
    while (by_face_[c] != kSource) {
      const int f = by_face_[c];
      c = across(f, c);
      flow_[f] += outwards(f, c);
    }
  }

  int across(int f, int from) const {
    const auto& [a, b] = bc_.faces[f].components;
    return a == from ? b : a;
  }
  int outwards(int f, int from) const { return bc_.faces[f].components[0] == from ? 1 : -1; }

  static constexpr int kUnreached = -2, kSource = -1;
  const BaseComplex& bc_;
  std::vector<int> flow_;  // by base face: from its first component to the second
  std::vector<char> is_sink_;
  std::span<const int> sources_;
  std::vector<int> reached_, by_face_;  // in this search; the face that a component was reached by
};

}  // namespace

ComponentCut smallest_cut(const BaseComplex& bc, std::span<const int> inside,
                          std::span<const int> outside) {
  return Network(bc, inside, outside).cut();
}

}  // namespace hexweft
