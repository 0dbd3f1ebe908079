/// \file
/// A distortion energy as a value: any struct that answers the questions below becomes an `Energy`.
///
///     struct MyEnergy { ... };              // in a file of your own
///     const Energy energy = MyEnergy{};     // goes wherever an energy is taken
///
/// The kernels over the eight corners of a hexahedron are compiled, for every instruction set, where
/// the struct is first turned into an `Energy`; those of table.h come ready-made.
#pragma once

#include <concepts>
#include <memory>
#include <string_view>
#include <utility>

#include <Eigen/Core>

#include "optimize/energies/deformation.h"
#include "optimize/energies/kernels.h"
#include "optimize/hex_batch.h"

namespace hexweft {

/// What an energy states of itself:
///     static constexpr std::string_view name;    // its name on the command line
///     static constexpr bool barrier;             // infinite as det J → 0⁺, not defined beyond
///     double minimum() const;                    // its value at rotations
///     T value_and_stress(const Deformation<T>&, Mat3<T>& stress) const;   // stress = ∂ value / ∂J
///     Curvature<T> curvature(const Deformation<T>&) const;                // deformation.h
///     Eigen::Vector3d d_sigma(const Eigen::Vector3d& sigma) const;        // by singular values
/// The two with a T are either templates marked HEXWEFT_INLINE, called with `double` and `Lanes`,
/// or plain functions of `double`, called once for each corner. An energy may also have
///     void residual(const Deformation<double>&, Mat3<double>& r) const;
///     Mat3<double> residual_change(const Deformation<double>&, int column, int axis) const;
/// with |r|² = value − minimum, and its derivative along e_axis e_columnᵀ: the residual blocks take it.
/// One that knows the axes of the target cuboid, so that a rotation on their side changes it, says
///     static constexpr bool isotropic = false;
/// and its d_sigma holds for J = diag(σ) alone.
template <class E>
concept DistortionEnergy = requires(const E& e, const Deformation<double>& d, Mat3<double>& stress,
                                    const Eigen::Vector3d& sigma) {
  { E::name } -> std::convertible_to<std::string_view>;
  { E::barrier } -> std::convertible_to<bool>;
  { e.minimum() } -> std::convertible_to<double>;
  { e.value_and_stress(d, stress) } -> std::convertible_to<double>;
  { e.curvature(d) } -> std::convertible_to<Curvature<double>>;
  { e.d_sigma(sigma) } -> std::convertible_to<Eigen::Vector3d>;
};

template <class E>
concept HasResidual = requires(const E& e, const Deformation<double>& d, Mat3<double>& r) {
  e.residual(d, r);
  { e.residual_change(d, 0, 0) } -> std::convertible_to<Mat3<double>>;
};

/// An energy behind virtual calls: one a batch of hexahedra, or one a corner.
class EnergyModel {
 public:
  EnergyModel() = default;
  EnergyModel(const EnergyModel&) = delete;
  EnergyModel& operator=(const EnergyModel&) = delete;
  virtual ~EnergyModel() = default;

  virtual std::string_view name() const = 0;
  virtual bool barrier() const = 0;
  virtual bool isotropic() const = 0;
  virtual double minimum() const = 0;
  virtual double value_and_stress(const Deformation<double>& d, Mat3<double>& stress) const = 0;
  virtual Curvature<double> curvature(const Deformation<double>& d) const = 0;
  virtual Eigen::Vector3d d_sigma(const Eigen::Vector3d& sigma) const = 0;
  /// False if the energy states no residual.
  virtual bool has_residual() const = 0;
  /// \param change  null, or [3 · column + axis], the derivative along e_axis e_columnᵀ
  virtual void residual(const Deformation<double>& d, Mat3<double>& r,
                        Mat3<double>* change) const = 0;

  /// hex_energy.h has these with their meaning.
  virtual double batch_energy(const HexBatch& batch, double* gradient,
                              InstructionSet set) const = 0;
  virtual void add_curvature(const HexBatch& batch, double* blocks, InstructionSet set) const = 0;
  virtual double edge_terms(const HexBatch& batch, std::span<const HexEdges> edges, double* terms,
                            InstructionSet set) const = 0;
};

template <DistortionEnergy E>
class EnergyModelOf final : public EnergyModel {
 public:
  explicit EnergyModelOf(const E& energy) : energy_(energy) {}

  std::string_view name() const override { return E::name; }
  bool barrier() const override { return E::barrier; }
  bool isotropic() const override {
    if constexpr (requires { E::isotropic; }) {
      return E::isotropic;
    } else {
      return true;
    }
  }
  double minimum() const override { return energy_.minimum(); }
  double value_and_stress(const Deformation<double>& d, Mat3<double>& stress) const override {
    return energy_.value_and_stress(d, stress);
  }
  Curvature<double> curvature(const Deformation<double>& d) const override {
    return energy_.curvature(d);
  }
  Eigen::Vector3d d_sigma(const Eigen::Vector3d& sigma) const override {
    return energy_.d_sigma(sigma);
  }
  bool has_residual() const override { return HasResidual<E>; }
  void residual(const Deformation<double>& d, Mat3<double>& r,
                Mat3<double>* change) const override {
    if constexpr (HasResidual<E>) {
      energy_.residual(d, r);
      for (int k = 0; change && k < 9; ++k) change[k] = energy_.residual_change(d, k / 3, k % 3);
    }
  }

  double batch_energy(const HexBatch& batch, double* gradient, InstructionSet set) const override {
    return kernels::run<kernels::BatchEnergy>(set, energy_, batch, gradient);
  }
  void add_curvature(const HexBatch& batch, double* blocks, InstructionSet set) const override {
    kernels::run<kernels::AddCurvature>(set, energy_, batch, blocks);
  }
  double edge_terms(const HexBatch& batch, std::span<const HexEdges> edges, double* terms,
                    InstructionSet set) const override {
    return kernels::run<kernels::EdgeTerms>(set, energy_, batch, edges, terms);
  }

 private:
  E energy_;
};

/// An energy with its parameters. Copies share what never changes, so they cost next to nothing and
/// may be used by several threads.
class Energy {
 public:
  template <class E>
  requires DistortionEnergy<E> Energy(
      const E& energy)  // NOLINT(google-explicit-constructor): energies are passed by their type
      : model_(std::make_shared<const EnergyModelOf<E>>(energy)) {}

  std::string_view name() const { return model_->name(); }
  bool barrier() const { return model_->barrier(); }
  bool isotropic() const { return model_->isotropic(); }
  double minimum() const { return model_->minimum(); }
  double value_and_stress(const Deformation<double>& d, Mat3<double>& stress) const {
    return model_->value_and_stress(d, stress);
  }
  Curvature<double> curvature(const Deformation<double>& d) const { return model_->curvature(d); }
  Eigen::Vector3d d_sigma(const Eigen::Vector3d& sigma) const { return model_->d_sigma(sigma); }
  const EnergyModel& model() const { return *model_; }

 private:
  std::shared_ptr<const EnergyModel> model_;
};

inline std::string_view name(const Energy& energy) { return energy.name(); }

}  // namespace hexweft
