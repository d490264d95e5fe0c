#include "common/program/picture_samples.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace talus::program {
namespace {

Samples sampled(const Surface& surface, std::size_t facet, std::size_t columns, std::size_t rows) {
  Samples samples{columns, {}, {}};
  const auto place = [](std::size_t i, std::size_t count) {
    return 2 * static_cast<double>(i) / static_cast<double>(count - 1) - 1;
  };
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < columns; ++i) {
      const fem::Point<2> reference(place(i, columns), place(j, rows));
      samples.at.push_back(surface.sample(facet, reference));
      if (surface.stream) samples.stream.push_back(surface.stream(facet, reference));
    }
  return samples;
}

// At a free surface, without pressure, I is nothing over nothing: what the law makes of the point
// beside it is shown.
void look_beside_free_surfaces(Samples& samples) {
  double largest = 0;
  for (const PictureSample& each : samples.at)
    largest = std::max(largest, std::abs(each.law.total_pressure));
  const auto has_pressure = [&](std::size_t k) {
    return std::abs(samples.at[k].law.total_pressure) > 1e-9 * largest;
  };
  const std::size_t columns = samples.columns, rows = samples.rows();
  for (std::size_t k = 0; k < samples.at.size(); ++k) {
    if (has_pressure(k)) continue;
    const std::size_t row = k / columns, column = k % columns;
    std::vector<std::size_t> beside;
    if (row > 0) beside.push_back(k - columns);
    if (row + 1 < rows) beside.push_back(k + columns);
    if (column > 0) beside.push_back(k - 1);
    if (column + 1 < columns) beside.push_back(k + 1);
    const auto found = std::ranges::find_if(beside, has_pressure);
    if (found == beside.end()) continue;
    samples.at[k].stress = samples.at[*found].stress;
    const double pressure = samples.at[k].law.total_pressure;
    samples.at[k].law = samples.at[*found].law;
    samples.at[k].law.total_pressure = pressure;
  }
}

double distance(const PictureSample& a, const PictureSample& b) {
  return std::hypot(a.at[0] - b.at[0], a.at[1] - b.at[1]);
}

bool is_seen(const Samples& samples, const io::Window& window) {
  for (const std::size_t d : {0u, 1u}) {
    double low = samples.at[0].at[d], high = low;
    for (const PictureSample& each : samples.at) {
      low = std::min(low, each.at[d]);
      high = std::max(high, each.at[d]);
    }
    if (high < window.low[d] || low > window.high[d]) return false;
  }
  return true;
}

// Sides of facets that are divided alike: opposite ones, and with them those of the neighbours.
class SideGroups {
 public:
  explicit SideGroups(const io::Window& window)
      : grid_(1e-7 * std::max(window.extent(0), window.extent(1))) {}

  // Sides are known by their middles; `length` is the longer one's.
  void join(const PictureSample& one, const PictureSample& other, double length) {
    const std::size_t a = root(side_at(one)), b = root(side_at(other));
    parents_[b] = a;
    lengths_[a] = std::max({lengths_[a], lengths_[b], length});
  }
  double longest_like(const PictureSample& middle) { return lengths_[root(side_at(middle))]; }

 private:
  std::size_t side_at(const PictureSample& middle) {
    const std::array<long, 2> key{std::lround(middle.at[0] / grid_),
                                  std::lround(middle.at[1] / grid_)};
    const auto [place, is_new] = sides_.try_emplace(key, parents_.size());
    if (is_new) {
      parents_.push_back(place->second);
      lengths_.push_back(0);
    }
    return place->second;
  }
  std::size_t root(std::size_t side) {
    while (parents_[side] != side) side = parents_[side] = parents_[parents_[side]];
    return side;
  }

  double grid_;
  std::map<std::array<long, 2>, std::size_t> sides_;
  std::vector<std::size_t> parents_;
  std::vector<double> lengths_;
};

// Of a 3 x 3 grid: the middles of the sides that run along ξ (step 1) or η (step 3).
struct OppositeSides {
  const PictureSample &first, &second;
  double longest = 0;

  OppositeSides(const Samples& coarse, std::size_t step)
      : first(coarse.at[step]), second(coarse.at[8 - step]) {
    for (const std::size_t start : {std::size_t{0}, 8 - 2 * step})
      longest =
          std::max(longest, distance(coarse.at[start], coarse.at[start + step]) +
                                distance(coarse.at[start + step], coarse.at[start + 2 * step]));
  }
};

}  // namespace

Samples Samples::mirrored() const {
  Samples other = *this;
  for (PictureSample& sample : other.at) sample.at[0] = -sample.at[0];
  return other;
}

io::Window window_around(const Surface& surface) {
  std::vector<io::FieldPatch> corners(1);
  for (std::size_t facet = 0; facet < surface.count; ++facet)
    for (const PictureSample& sample : sampled(surface, facet, 2, 2).at)
      corners[0].points.push_back(sample.at);
  io::Window window = io::box_of(corners);
  if (surface.is_mirrored) window.low[0] = std::min(window.low[0], -window.high[0]);
  return window;
}

std::vector<Samples> samples_of(const Surface& surface, const io::Window& window) {
  std::map<std::size_t, Samples> seen;  // coarsely, by facet
  SideGroups groups(window);
  for (std::size_t facet = 0; facet < surface.count; ++facet) {
    Samples coarse = sampled(surface, facet, 3, 3);
    if (!is_seen(coarse, window) && !(surface.is_mirrored && is_seen(coarse.mirrored(), window)))
      continue;
    for (const std::size_t step : {1u, 3u}) {
      const OppositeSides sides(coarse, step);
      groups.join(sides.first, sides.second, sides.longest);
    }
    seen.emplace(facet, std::move(coarse));
  }

  constexpr double along_window = 80, most = 24;
  const double cell = std::max(window.extent(0), window.extent(1)) / along_window;
  std::vector<Samples> all;
  for (const auto& [facet, coarse] : seen) {
    const auto points = [&, &at = coarse.at](std::size_t middle) {
      const double cells = std::ceil(groups.longest_like(at[middle]) / cell);
      return static_cast<std::size_t>(std::clamp(cells, 1., most)) + 1;
    };
    Samples fine = sampled(surface, facet, points(1), points(3));
    look_beside_free_surfaces(fine);
    if (surface.is_mirrored) all.push_back(fine.mirrored());
    all.push_back(std::move(fine));
  }
  return all;
}

}  // namespace talus::program
