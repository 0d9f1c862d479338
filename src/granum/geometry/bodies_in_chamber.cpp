#include "granum/geometry/bodies_in_chamber.hpp"

#include "granum/geometry/open_part.hpp"

#include <algorithm>
#include <queue>

namespace granum::geometry
{
namespace
{
constexpr std::size_t layers = 48, across = 12;  // of boxes in which volumes are taken
constexpr std::size_t face_parts = 32;           // of plate and outlet, in each direction
constexpr int most_looks = 20000;

double end_area(Region const& region, bool upper)
{
    Vec3 const low = region.lower(), high = region.upper();
    double const height = high.z - low.z, z = upper ? high.z : low.z;
    double const dx = (high.x - low.x) / face_parts, dy = (high.y - low.y) / face_parts;
    Beside const beside = upper ? Beside{.below = height / layers, .above = 0} : Beside{0, height / layers};
    double sum = 0;
    for (std::size_t j = 0; j < face_parts; ++j)
        for (std::size_t i = 0; i < face_parts; ++i) {
            Vec3 const from{low.x + static_cast<double>(i) * dx, low.y + static_cast<double>(j) * dy, z};
            sum += open_area(region, 2, from, from + Vec3{dx, dy, 0}, beside);
        }
    return sum;
}

std::shared_ptr<Levels const> measure(Region const& region)
{
    Vec3 const low = region.lower(), high = region.upper();
    Vec3 const step{(high.x - low.x) / across, (high.y - low.y) / across, (high.z - low.z) / layers};
    Levels out{.bottom = low.z,
               .top = high.z,
               .below = {0},
               .plate = end_area(region, false),
               .outlet = end_area(region, true)};
    for (std::size_t k = 0; k < layers; ++k) {
        double sum = out.below.back();
        for (std::size_t j = 0; j < across; ++j)
            for (std::size_t i = 0; i < across; ++i) {
                Vec3 const from = low + Vec3{static_cast<double>(i) * step.x, static_cast<double>(j) * step.y,
                                             static_cast<double>(k) * step.z};
                sum += open_volume(region, from, from + step);
            }
        out.below.push_back(sum);
    }
    return std::make_shared<Levels const>(std::move(out));
}
}

Chamber chamber_of(Region region)
{
    Chamber out;
    out.shape = Chamber::Shape::solids;
    out.levels = measure(region);
    out.region = std::make_shared<Region const>(std::move(region));
    return out;
}

Chamber with_bodies(Chamber chamber, std::vector<Region> const& bodies)
{
    if (bodies.empty()) return chamber;
    Region open = chamber.region ? *chamber.region : Region("chamber", chamber);
    for (auto const& body : bodies) open = open - body;
    chamber.levels = measure(open);
    chamber.region = std::make_shared<Region const>(std::move(open));
    return chamber;
}

std::optional<Vec3> common_place(Depth const& one, Depth const& other, Bounds const& box, double least)
{
    struct Part
    {
        double depth;
        Vec3 middle, half;
        bool operator<(Part const& than) const { return depth < than.depth; }
    };
    auto const look = [&](Vec3 const& middle, Vec3 const& half) {
        double const first = one(middle);
        return Part{first < -norm(half) ? first : std::min(first, other(middle)), middle, half};
    };
    for (std::size_t d = 0; d < 3; ++d)
        if (!(box.lower[d] < box.upper[d])) return std::nullopt;
    std::priority_queue<Part> parts;
    parts.push(look(0.5 * (box.lower + box.upper), 0.5 * (box.upper - box.lower)));
    for (int looks = 1; !parts.empty() && looks < most_looks; looks += 8) {
        Part const part = parts.top();
        parts.pop();
        if (part.depth > least) return part.middle;
        if (part.depth + norm(part.half) <= least) continue;
        Vec3 const half = 0.5 * part.half;
        for (int corner = 0; corner < 8; ++corner) {
            Vec3 const way{corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y, corner & 4 ? half.z : -half.z};
            parts.push(look(part.middle + way, half));
        }
    }
    return std::nullopt;
}
}
