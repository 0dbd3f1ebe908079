/// \file
/// Which way the triangles of a surface face.
///
///     const int n_turned = orient_surface(points, triangles);
///
/// Files are not always right about it, and closest points go by it.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

namespace hexweft {

/// Makes the triangles of every piece agree, and those of closed pieces face out of the solid.
/// A piece is what hangs together across edges of exactly two triangles; it is closed where every
/// edge is gone along as often one way as the other. One that lies within an odd number of other
/// closed ones is the wall of a cavity and faces into it. An open piece keeps the side that most of
/// its triangles face to; one that has no two sides stays as it is.
/// \param points     3 × #points, finite
/// \param triangles  indices into points; their order stays, turned ones swap their last two corners
/// \return           how many triangles were turned
/// Cost O(#triangles log #triangles), and for closed pieces that lie within each other's boxes
/// O(#pieces #triangles).
/// Source: A. van Oosterom, J. Strackee, "The Solid Angle of a Plane Triangle", IEEE Trans. Biomed.
/// Eng. 30 (1983), for the winding number that tells what lies within what.
int orient_surface(const Eigen::Matrix3Xd& points, std::vector<std::array<int, 3>>& triangles);

}  // namespace hexweft
