#include "pencil/select.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "options/options.hpp"
#include "petsc/text.hpp"
#include "session/stages.hpp"

namespace squeal::flutter {
namespace {

const RealListOption frictionOption("flutter", "flutter_friction", "0.4", "", nonNegative, "friction coefficients", true);
const RealListOption speedOption("flutter", "flutter_speed", "1", "", positive,
                                 "factors on all -motion_* and obstacle velocities, swept", true);
const RealListOption pressureOption(
    "flutter", "flutter_pressure", "1", "", positive,
    "factors on all that presses, swept: -load_<group>_pressure, -constraint_<group>_displacement and "
    "-contact_<interface>_obstacle_displacement; not on centrifugal forces",
    true);
const RealListOption dampingOption("flutter", "flutter_damping", "1", "", nonNegative,
                                   "factors on the damping of materials, of -ground_<group>_damping and of -flutter_modal_damping, "
                                   "swept; not on that of friction",
                                   true);
const ChoiceOption methodOption("flutter", "flutter_method", {"reduced", "direct"}, "reduced",
                                "reduced: dense problem on the free modes; direct: all unknowns, for checking");
const RealOption bandOption(
    "flutter", "flutter_band", 0, "Hz", nonNegative,
    "|s|/(2 pi), for little damping the frequency, up to which eigenvalues are corrected and listed, as far as "
    "the free modes reach; 0: the frequency of mode 0.55 x -modes_count");
const RealOption bandDampingOption("flutter", "flutter_band_damping", 0.5, "", positive,
                                   "eigenvalues of a larger damping ratio, which die away within a cycle, are not listed");
const RealOption accuracyOption("flutter", "flutter_accuracy", 1e-9, "", positive,
                                "full-order backward error up to which an eigenvalue is certified, and to which it is corrected");
const RealOption toleranceOption("flutter", "flutter_unstable_tolerance", 1e-6, "", nonNegative,
                                 "unstable if the growth rate exceeds this fraction of |s|");
const IntegerOption shapesOption("flutter", "flutter_shapes", 3, 0, 100'000,
                                 "number of fastest growing complex modes kept for the report at each friction");
const RealOption shapesBelowOption("flutter", "flutter_shapes_below", 20000, "Hz", positive,
                                   "complex modes of higher frequency are not kept; squeal is what can be heard");

}  // namespace

Sweep readSweep() {
  const auto ascending = [](const RealListOption& option) {
    auto list = option.get();
    if (list.empty()) throw Error("option -" + option.fullName() + ": the list is empty");
    std::sort(list.begin(), list.end());  // each steady solution starts from a neighbour
    if (std::adjacent_find(list.begin(), list.end()) != list.end())
      throw Error("option -" + option.fullName() + ": a value is given twice");
    return list;
  };
  Sweep sweep{ascending(frictionOption), ascending(speedOption), ascending(pressureOption), ascending(dampingOption)};
  const double points = sweep.pointCount();
  if (points > mostPoints)
    throw Error(
        formatted("options -flutter_friction, -flutter_speed, -flutter_pressure and -flutter_damping: %zu x %zu x %zu x %zu = %.0f "
                  "points; a sweep has %.0f at most",
                  sweep.frictions.size(), sweep.speeds.size(), sweep.pressures.size(), sweep.dampings.size(), points, mostPoints));
  return sweep;
}

double Sweep::pointCount() const {
  return static_cast<double>(frictions.size()) * static_cast<double>(speeds.size()) * static_cast<double>(pressures.size()) *
         static_cast<double>(dampings.size());
}

void warnOfLongSweep(MPI_Comm comm, const Sweep& sweep, int modes) {
  constexpr double many = 1000, perSecond = 1e10;
  if (sweep.pointCount() < many || directWanted()) return;
  // QZ of the linearised problem of a basis of twice the modes, some 25 (2 m)^3 operations with m vectors.
  const double hours = sweep.pointCount() * 25 * std::pow(4.0 * modes, 3) / perSecond / 3600;
  complain(
      comm,
      formatted(
          "a sweep of %.0f points, %.0f steady states: about %.2g hours for their dense eigenvalue problems alone (%d free modes)",
          sweep.pointCount(), sweep.pointCount() / static_cast<double>(sweep.dampings.size()), hours, modes));
}

std::vector<Parameters> Sweep::steadyPoints() const {
  std::vector<Parameters> points;
  for (double speed : speeds)
    for (double pressure : pressures)
      for (double friction : frictions) points.push_back({friction, speed, pressure, 1});
  return points;
}

std::vector<Parameters> Sweep::points() const {
  std::vector<Parameters> points;
  for (double damping : dampings)
    for (Parameters at : steadyPoints()) {
      at.damping = damping;
      points.push_back(at);
    }
  return points;
}

std::optional<std::size_t> Sweep::earlierNeighbour(std::size_t steadyPoint) const {
  const std::size_t row = frictions.size(), plane = row * pressures.size();
  if (steadyPoint % row >= 1) return steadyPoint - 1;
  if (steadyPoint % plane >= row) return steadyPoint - row;
  if (steadyPoint >= plane) return steadyPoint - plane;
  return std::nullopt;
}

double bandAsked() { return 2 * M_PI * bandOption.get(); }

double bandDamping() { return bandDampingOption.get(); }

double bandBelow(const std::vector<double>& w) {
  constexpr double apart = 1 + 1e-4;
  // Between two modes that are not a double one no eigenvalue sits on the edge for rounding to decide; the last may lack its double.
  const auto edge = [&](std::size_t k) { return k > 0 && w[k] >= apart * w[k - 1]; };  // below mode k
  const auto middle = [&](std::size_t k) { return k > 0 ? 0.5 * (w[k - 1] + w[k]) : apart * w.back(); };
  std::size_t last = w.size() - 1;
  while (last > 0 && !edge(last)) --last;
  if (bandAsked() > 0) return std::min(bandAsked(), middle(last));
  std::size_t k = std::min(w.size() * 11 / 20 + 1, last);
  while (k < last && !edge(k)) ++k;
  return middle(k);
}

double accuracyAsked() { return accuracyOption.get(); }

std::vector<std::vector<std::size_t>> batches(const std::vector<Parameters>& points) {
  // The ends of a range, its middle and its quarters build most of the basis; later points find it ready, and cost a round or two.
  constexpr std::size_t first = 5, later = 16;
  std::array<double, allParameters.size()> ranges{};
  for (std::size_t k = 0; k < ranges.size() && !points.empty(); ++k) {
    const auto value = allParameters[k].value;
    const auto [low, high] =
        std::minmax_element(points.begin(), points.end(), [&](const auto& p, const auto& q) { return p.*value < q.*value; });
    ranges[k] = (*high).*value - (*low).*value;
  }
  const auto apart = [&](std::size_t a, std::size_t b) {
    double sum = 0;
    for (std::size_t k = 0; k < ranges.size(); ++k) {
      const auto value = allParameters[k].value;
      if (ranges[k] > 0) sum += std::pow((points[a].*value - points[b].*value) / ranges[k], 2);
    }
    return sum;
  };
  std::vector<double> distance(points.size(), INFINITY);  // to the nearest point already chosen
  std::vector<std::vector<std::size_t>> result;
  std::size_t next = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].friction > points[next].friction) next = i;
  for (std::size_t chosen = 0; chosen < points.size(); ++chosen) {
    if (chosen == 0 || (chosen >= first && (chosen - first) % later == 0)) result.emplace_back();
    result.back().push_back(next);
    for (std::size_t i = 0; i < points.size(); ++i) distance[i] = std::min(distance[i], apart(i, next));
    distance[next] = -1;
    next = static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) - distance.begin());
  }
  return result;
}

bool directWanted() { return methodOption.get() == "direct"; }

int FrictionPoint::modesWithoutEigenvalue() const {
  return damped ? std::max(0, freeModesInBand - static_cast<int>(eigenvalues.size())) : 0;
}

int FrictionPoint::unstableCount() const {
  return static_cast<int>(std::count_if(eigenvalues.begin(), eigenvalues.end(), [](const auto& e) { return e.unstable; }));
}

int FrictionPoint::uncertifiedCount() const {
  return static_cast<int>(std::count_if(eigenvalues.begin(), eigenvalues.end(), [](const auto& e) { return !e.certified; }));
}

double FrictionPoint::worstBackwardError() const {
  double worst = 0;
  for (const auto& eigenvalue : eigenvalues) worst = std::max(worst, eigenvalue.backwardError);
  return worst;
}

double FrictionPoint::worstErrorEstimate() const {
  double worst = 0;
  for (const auto& eigenvalue : eigenvalues)
    if (!std::isnan(worst) && !(eigenvalue.errorEstimate <= worst)) worst = eigenvalue.errorEstimate;
  return worst;
}

const Eigenvalue* FrictionPoint::fastestGrowing() const {
  const Eigenvalue* fastest = nullptr;
  for (const auto& eigenvalue : eigenvalues)
    if (!fastest || eigenvalue.s.real() > fastest->s.real()) fastest = &eigenvalue;
  return fastest;
}

void judge(std::vector<Eigenvalue>& eigenvalues) {
  const double tolerance = toleranceOption.get();
  for (auto& eigenvalue : eigenvalues) eigenvalue.unstable = eigenvalue.s.real() > tolerance * std::abs(eigenvalue.s);
}

std::vector<std::size_t> shapesWanted(const FrictionPoint& point) {
  std::vector<std::size_t> order;
  const double below = 2 * M_PI * shapesBelowOption.get();
  for (std::size_t i = 0; i < point.eigenvalues.size(); ++i)
    if (point.eigenvalues[i].unstable && point.eigenvalues[i].s.imag() < below) order.push_back(i);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return point.eigenvalues[a].s.real() > point.eigenvalues[b].s.real(); });
  order.resize(std::min(order.size(), static_cast<std::size_t>(shapesOption.get())));
  return order;
}

void keepShapes(FrictionPoint& point, Mat trial, const std::vector<std::size_t>& indices, std::vector<ComplexVector> modes) {
  for (std::size_t k = 0; k < indices.size(); ++k) {
    Shape shape{};
    shape.index = indices[k];
    shape.unknowns = std::move(modes[k]);
    check(MatCreateVecs(trial, nullptr, shape.real.out()));
    check(VecDuplicate(shape.real, shape.imaginary.out()));
    check(MatMult(trial, shape.unknowns.real, shape.real));
    check(MatMult(trial, shape.unknowns.imaginary, shape.imaginary));
    PetscReal a = 0, b = 0;
    check(VecNorm(shape.real, NORM_INFINITY, &a));
    check(VecNorm(shape.imaginary, NORM_INFINITY, &b));
    for (Vec part : {shape.real.get(), shape.imaginary.get(), shape.unknowns.real.get(), shape.unknowns.imaginary.get()})
      check(VecScale(part, 1 / std::max(a, b)));
    point.shapes.push_back(std::move(shape));
  }
}

}  // namespace squeal::flutter
