#include "io/gmsh_nodes.h"

namespace hexweft::detail {
namespace {

std::string a_count() { return "the number of nodes in [0, " + std::to_string(kMostPoints) + "]"; }

}  // namespace

void GmshNodes::read(GmshValues& in, bool parametric) {
  if (in.version() == GmshVersion::v2) {
    const std::int64_t n = in.read_int({0, kMostPoints}, a_count);
    in.begin_binary();
    read_rows(in, n, parametric);
  } else {
    in.begin_binary();
    read_blocks(in);
  }
  in.expect_end();
  sorted_tags_.reserve(tags_.size());
  for (std::size_t i = 0; i < tags_.size(); ++i) sorted_tags_.add(tags_[i], static_cast<int>(i));
  if (const int second = sorted_tags_.sort(); second >= 0) {
    in.fail(where_[second], "node " + std::to_string(tags_[second]) + " appears twice");
  }
}

// Version 2: tag and place; dimension and tag of the entity with parameters on a curve or surface.
void GmshNodes::read_rows(GmshValues& in, std::int64_t n, bool parametric) {
  data_.points.reserve(in.room_for(n, 4));
  tags_.reserve(in.room_for(n, 4));
  for (std::int64_t i = 0; i < n; ++i) {
    read_tag(in);
    read_place(in);
    if (!parametric) continue;
    const GmshEntity entity = in.read_entity();
    skip_parameters(in, entity.dimension == 3 ? 0 : entity.dimension);
  }
}

// From version 4 on: blocks of nodes of one volume, surface, curve or point.
void GmshNodes::read_blocks(GmshValues& in) {
  const std::int64_t n_blocks = in.read_size(kGmshSizes, "the number of blocks of nodes");
  const std::int64_t n = in.read_size({0, kMostPoints}, a_count);
  if (in.version() == GmshVersion::v41) {
    in.read_size(kGmshSizes, "the least tag of a node");
    in.read_size(kGmshSizes, "the greatest tag of a node");
  }
  data_.points.reserve(in.room_for(n, 4));
  tags_.reserve(in.room_for(n, 4));
  for (std::int64_t b = 0; b < n_blocks; ++b) read_block(in, n);
  if (std::ssize(tags_) < n) {
    in.fail(in.header(), "$Nodes: expected " + std::to_string(n) + " nodes, found " +
                             std::to_string(tags_.size()) + " in its blocks");
  }
}

// Since version 4.1 all tags of a block come before all its places.
void GmshNodes::read_block(GmshValues& in, std::int64_t n) {
  const GmshEntity entity = in.read_entity();
  const bool parametric = in.read_int({0, 1}, "0 or 1 for nodes with parameters") == 1;
  const std::int64_t n_left = n - std::ssize(tags_);
  const std::int64_t n_in_block = in.read_size(
      {0, n_left}, [&] { return "at most " + std::to_string(n_left) + " nodes in a block"; });
  const std::int64_t n_parameters = parametric ? entity.dimension : 0;
  const bool tags_first = in.version() == GmshVersion::v41;
  for (std::int64_t i = 0; tags_first && i < n_in_block; ++i) read_tag(in);
  for (std::int64_t i = 0; i < n_in_block; ++i) {
    if (!tags_first) read_tag(in);
    read_place(in);
    skip_parameters(in, n_parameters);
  }
}

void GmshNodes::read_tag(GmshValues& in) {
  where_.push_back(in.where());
  tags_.push_back(in.read_tag(kGmshTags, [&] {
    return "the tag, 1 or more, of node " + std::to_string(tags_.size() + 1) + " in the file";
  }));
}

void GmshNodes::read_place(GmshValues& in) {
  Eigen::Vector3d& place = data_.points.emplace_back();
  for (double& x : place) {
    x = in.read_finite(
        [&] { return "a finite coordinate of node " + std::to_string(tag_of_place()); });
  }
}

void GmshNodes::skip_parameters(GmshValues& in, std::int64_t n) {
  for (std::int64_t i = 0; i < n; ++i) {
    in.read_real([&] { return "a parameter of node " + std::to_string(tag_of_place()); });
  }
}

}  // namespace hexweft::detail
