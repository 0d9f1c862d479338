#include "granum/dem/layers.hpp"

#include <algorithm>
#include <cmath>

namespace granum::dem
{
namespace
{
// No fewer rows to a layer, so that what begins a pass is little beside it.
constexpr double fewest_rows = 300;
// A part of a millionth more, so that rounding never brings two that touch two layers apart.
constexpr double with_rounding = 1 + 1e-6;

// Where a row is along an axis: from the end of what the granules fill; where the domain is periodic, from its middle
// both ways. Differs for two granules by no more than they are apart.
struct Axis
{
    std::size_t d;
    double from;

    Axis(std::size_t axis, Domain const& domain, Vec3 const& low)
        : d(axis), from(domain.periodic[axis] ? 0.5 * (domain.lower[axis] + domain.upper[axis]) : low[axis])
    {
    }
    double operator()(kernel::Body const& body) const { return std::abs(body.position[d] - from); }
};
}

void Layers::make(Frame const& frame, Domain const& domain, par::Partition const& partition, int rank, double reach,
                  double most_rows)
{
    std::size_t const owned = frame.owned;
    Vec3 low, high;
    if (owned > 0) low = high = frame.position(0);
    for (std::size_t row = 1; row < owned; ++row)
        for (std::size_t d = 0; d < 3; ++d) {
            double const x = frame.bodies[row].position[d];
            low[d] = std::min(low[d], x), high[d] = std::max(high[d], x);
        }
    auto const longest = [](Vec3 const& of) -> std::size_t {
        return of.x >= std::max(of.y, of.z) ? 0 : of.y >= of.z ? 1 : 2;
    };
    Vec3 side = high - low;

    // A layer is a distance over the thickness, and distances of two granules differ by no more than they are apart.
    depth_.resize(owned);
    std::size_t through = longest(side);  // the layers
    if (auto const others = partition.near(rank, reach); !others.empty()) {
        Vec3 towards;
        for (std::size_t row = 0; row < owned; ++row) {
            Vec3 nearest = partition.off(frame.position(row), others[0]);
            for (std::size_t k = 1; k < others.size(); ++k)
                if (Vec3 const off = partition.off(frame.position(row), others[k]); norm2(off) < norm2(nearest))
                    nearest = off;
            depth_[row] = norm(nearest);
            towards = towards + nearest;
        }
        through = longest(towards);
    } else {
        Axis const along(through, domain, low);
        for (std::size_t row = 0; row < owned; ++row) depth_[row] = along(frame.bodies[row]);
    }
    double const most = owned > 0 ? *std::max_element(depth_.begin(), depth_.end()) : 0;
    double const thickness = reach * with_rounding, rows = static_cast<double>(owned);
    count_ = static_cast<std::size_t>(std::max(1.0, std::min(most / thickness, rows / fewest_rows)));
    double const scale = most > 0 ? static_cast<double>(count_) / most : 0;

    side[through] = 0;
    Axis const across(longest(side), domain, low);
    double widest = 0;
    for (std::size_t row = 0; row < owned; ++row) widest = std::max(widest, across(frame.bodies[row]));
    // At least half of a strip is behind what the steps of a sweep leave to the next.
    strips_ = static_cast<std::size_t>(std::max(1.0, std::min(std::ceil(rows / static_cast<double>(count_) / most_rows),
                                                              widest / (2.0 * most_steps * thickness))));
    units_ = (strips_ - 1) * most_steps + 1;
    double const width = widest / static_cast<double>(strips_), first = width - (most_steps - 1) * thickness;
    auto const unit = [&](double x) -> std::size_t {
        auto const strip = width > 0 ? std::min(static_cast<std::size_t>(x / width), strips_ - 1) : 0;
        double const within = x - static_cast<double>(strip) * width - first;
        if (within < 0 || strip + 1 == strips_) return strip * most_steps;
        return strip * most_steps + std::min(1 + static_cast<std::size_t>(within / thickness), most_steps - 1);
    };

    of_row_.assign(frame.rows(), 0);
    begin_.assign(count_ * units_ + 1, 0);
    for (std::size_t row = 0; row < owned; ++row) {
        auto const layer = std::min(static_cast<std::size_t>(depth_[row] * scale), count_ - 1);
        of_row_[row] = static_cast<std::uint32_t>(layer * units_ + unit(across(frame.bodies[row])));
        ++begin_[of_row_[row] + 1];
    }
    for (std::size_t k = 0; k < units(); ++k) begin_[k + 1] += begin_[k];
    rows_.resize(owned);
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t row = 0; row < owned; ++row) rows_[next[of_row_[row]]++] = static_cast<std::uint32_t>(row);
}
}
