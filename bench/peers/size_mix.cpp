// Random sequential placement, the largest spheres first: the small ones find room between the large.
#include "peers/size_mix.hpp"

#include "granum/base/error.hpp"
#include "granum/math/constants.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace granum::peers
{
namespace
{
// The same numbers with every standard library: its distributions differ, its engines do not.
class Uniform
{
  public:
    double operator()(double low, double high)
    {
        return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
    }

  private:
    std::mt19937_64 engine_{20000};
};

// Placed spheres in cells as wide as the largest diameter, one grid per size: a small newcomer looks at few cells of
// its own size and at few spheres of the larger ones.
class Placed
{
  public:
    Placed(Vec3 const& box, std::vector<double> const& radii) : box_(box), radii_(radii)
    {
        for (double const radius : radii) {
            auto& grid = grids_.emplace_back();
            for (std::size_t d = 0; d < 3; ++d)
                grid.cells[d] = std::max<long>(1, static_cast<long>(box[d] / (2 * radius)));
            grid.members.resize(static_cast<std::size_t>(grid.cells[0] * grid.cells[1] * grid.cells[2]));
        }
    }

    bool free(Vec3 const& at, double radius) const
    {
        for (std::size_t size = 0; size < grids_.size(); ++size) {
            auto const& grid = grids_[size];
            double const reach = radius + radii_[size];
            std::array<long, 3> low, high;
            for (std::size_t d = 0; d < 3; ++d) {
                low[d] = cell(grid, d, at[d] - reach);
                high[d] = cell(grid, d, at[d] + reach);
            }
            for (long i = low[0]; i <= high[0]; ++i)
                for (long j = low[1]; j <= high[1]; ++j)
                    for (long k = low[2]; k <= high[2]; ++k)
                        for (auto const& other : grid.members[index(grid, i, j, k)])
                            if (norm2(other - at) < reach * reach) return false;
        }
        return true;
    }

    void add(Vec3 const& at, std::size_t size)
    {
        auto& grid = grids_[size];
        grid.members[index(grid, cell(grid, 0, at.x), cell(grid, 1, at.y), cell(grid, 2, at.z))].push_back(at);
    }

  private:
    struct Grid
    {
        std::array<long, 3> cells;
        std::vector<std::vector<Vec3>> members;
    };

    long cell(Grid const& grid, std::size_t d, double x) const
    {
        auto const count = grid.cells[d];
        return std::clamp(static_cast<long>(std::floor(x / box_[d] * static_cast<double>(count))), 0L, count - 1);
    }
    static std::size_t index(Grid const& grid, long i, long j, long k)
    {
        return static_cast<std::size_t>((i * grid.cells[1] + j) * grid.cells[2] + k);
    }

    Vec3 box_;
    std::vector<double> radii_;
    std::vector<Grid> grids_;
};
}

State five_sizes(long granules)
{
    constexpr double smallest = 1e-3, ratio = 10, solids = 0.42;
    std::vector<double> radii;
    for (int k = 4; k >= 0; --k) radii.push_back(smallest * std::pow(ratio, k / 4.0));
    double per_volume = 0;  // spheres in one unit of solids
    for (double const radius : radii) per_volume += 0.2 / (4.0 / 3.0 * math::pi * radius * radius * radius);
    double const volume = static_cast<double>(granules) / per_volume;

    double const width = std::cbrt(volume / solids);  // more than nine of the largest radii at 20,000
    Vec3 const box{width, width, width};
    State state{.length_x = width, .length_y = width, .density = 1500, .spheres = {}};
    Placed placed(box, radii);
    Uniform uniform;
    for (std::size_t size = 0; size < radii.size(); ++size) {
        double const r = radii[size];
        long const count = std::lround(0.2 * volume / (4.0 / 3.0 * math::pi * r * r * r));
        for (long k = 0, tries = 0; k < count; ++tries) {
            base::require(tries < 2000 * count, "no room for {} spheres of radius {} m", count, r);
            Vec3 const at{uniform(r, box.x - r), uniform(r, box.y - r), uniform(r, box.z - r)};
            if (!placed.free(at, r)) continue;
            placed.add(at, size);
            state.spheres.push_back({at, r, {}, {}});
            ++k;
        }
    }
    return state;
}
}
