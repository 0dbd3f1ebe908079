/// \file
/// Random numbers for tests.
#pragma once

#include <cstdint>
#include <random>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace hexweft {

/// Numbers that depend on the seed alone, not on the standard library.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  Eigen::Vector3d in_cube(double half) {
    const double x = uniform(-half, half), y = uniform(-half, half);
    return {x, y, uniform(-half, half)};
  }
  Eigen::Matrix3d rotation() {
    const Eigen::Vector3d axis = in_cube(1).normalized();
    return Eigen::AngleAxisd(uniform(0, 3), axis).toRotationMatrix();
  }
  int below(int n) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(n)); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace hexweft
