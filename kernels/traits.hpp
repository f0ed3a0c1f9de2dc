// The choices a scene makes that change arithmetic inside a loop. Each enumerator is spelt like its TOML word; `words` lists them in order.
#pragma once
#include <array>
#include <string_view>

namespace nanson {

enum class Law { linear_elastic, neo_hookean, mooney_rivlin, hencky_j2 };
enum class Volumetric { quadratic, barrier };  // U = kappa/2 (J-1)^2 (paper, eq. 14) | kappa/2 [(J^2-1)/2 - ln J]
enum class Isochoric { F, J };  // isochoric energy with det F | with the evolved J, as the paper writes it
enum class Formulation { pF, pFJ, pFHJ, pFp };  // what is carried besides {p, F}; pFp: the pressure, by projection
enum class Description {
  total,
  updated,
  pseudo_updated
};  // area vectors of the fluxes: H_ave C (paper, eq. 40) | of the dual of x (eq. 48) | H_x C (eq. 49)
enum class PressureJump { scalar, tensor };  // jump of Sigma_J (paper, Remark 4) | of P N (paper, eq. 36b)
enum class Stabilisation { upwind, jst };    // acoustic Riemann solver | Jameson-Schmidt-Turkel (paper, section 6.1)
enum class Reconstruction { constant, linear, limited };
enum class FluxCorrection { none, pressure, full };
enum class BoundaryFlux { adjoint, paper };
enum class UpwindMetric { deformed, paper };  // c_p max(1, |H N|) | c_p
enum class EntropyFix { none, edge };         // edge: no stabilisation against the plain jump
enum class Parting { none, energy };          // what ties J to det F: nothing but D^J | (M/2) (ln(det F/J))^2 too

constexpr auto words(Law) {
  return std::array<std::string_view, 4>{"linear_elastic", "neo_hookean", "mooney_rivlin", "hencky_j2"};
}
constexpr auto words(Volumetric) { return std::array<std::string_view, 2>{"quadratic", "barrier"}; }
constexpr auto words(Isochoric) { return std::array<std::string_view, 2>{"F", "J"}; }
constexpr auto words(Formulation) { return std::array<std::string_view, 4>{"pF", "pFJ", "pFHJ", "pFp"}; }
constexpr auto words(Description) { return std::array<std::string_view, 3>{"total", "updated", "pseudo_updated"}; }
constexpr auto words(PressureJump) { return std::array<std::string_view, 2>{"scalar", "tensor"}; }
constexpr auto words(Stabilisation) { return std::array<std::string_view, 2>{"upwind", "jst"}; }
constexpr auto words(Reconstruction) { return std::array<std::string_view, 3>{"constant", "linear", "limited"}; }
constexpr auto words(FluxCorrection) { return std::array<std::string_view, 3>{"none", "pressure", "full"}; }
constexpr auto words(BoundaryFlux) { return std::array<std::string_view, 2>{"adjoint", "paper"}; }
constexpr auto words(EntropyFix) { return std::array<std::string_view, 2>{"none", "edge"}; }
constexpr auto words(Parting) { return std::array<std::string_view, 2>{"none", "energy"}; }
constexpr auto words(UpwindMetric) { return std::array<std::string_view, 2>{"deformed", "paper"}; }

constexpr bool has_current_areas(Description d) { return d != Description::total; }
constexpr bool evolves_J(Formulation f) { return f == Formulation::pFJ || f == Formulation::pFHJ; }

/// The TOML word of a choice.
template <class Choice>
constexpr std::string_view word(Choice c) {
  return words(c)[static_cast<std::size_t>(c)];
}

}  // namespace nanson
