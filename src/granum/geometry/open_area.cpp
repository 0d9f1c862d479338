#include "granum/geometry/face_area.hpp"
#include "granum/geometry/thin_wall.hpp"

#include <algorithm>
#include <cmath>

namespace granum::geometry
{
namespace
{
//! The chamber's exact formulas, but closed where a wall lies on the face for a cell that has it.
double chamber_area(Chamber const& chamber, int direction, Vec3 const& low, Vec3 const& high, double aside,
                    Beside const& beside)
{
    bool const end = (beside.below > 0) != (beside.above > 0);
    for (double const way : {-aside, aside}) {
        if (end && (way < 0 ? beside.below : beside.above) <= 0) continue;
        Vec3 moved = low;
        moved[static_cast<std::size_t>(direction)] += way;
        if (chamber.open_area(direction, moved, high) <= 0) return 0;
    }
    return chamber.open_area(direction, low, high);
}
}

double open_area(Region const& region, int direction, Vec3 const& low, Vec3 const& high, Beside const& beside)
{
    auto const d = static_cast<std::size_t>(direction), u = (d + 1) % 3, v = (d + 2) % 3;
    double const half_u = 0.5 * (high[u] - low[u]), half_v = 0.5 * (high[v] - low[v]);
    double const depth = 0.5 * std::max(beside.below, beside.above), aside = 2 * on_face_within(direction, low, high);
    double const reach = std::sqrt(half_u * half_u + half_v * half_v), far = std::hypot(reach, depth);
    Vec3 middle = 0.5 * (low + high);
    middle[d] = low[d];
    double const free = region.at(middle, far).distance;
    if (free >= far) return 4 * half_u * half_v;
    if (free <= -reach) return 0;
    // A chamber's own wall is no thin wall.
    if (auto const* chamber = region.only_chamber(middle, far))
        return chamber_area(*chamber, direction, low, high, aside, beside);

    // At an end of the grid the face is looked at from within its cell: what lies on it is not seen.
    double const inwards = beside.below > 0 && beside.above > 0 ? 0
                           : beside.above > 0                   ? aside
                           : beside.below > 0                   ? -aside
                                                                : 0;
    Vec3 face_low = low;
    face_low[d] += inwards;
    middle[d] += inwards;
    FaceArea face(region, direction, face_low, high);
    double const area = face.open(middle, half_u, half_v);
    if (area <= 0 || depth <= 0) return area;
    ThinWall const thin(region, direction, face_low, high, beside);
    return thin.all_seen(face.seen()) ? area : thin.reached_area(face);
}
}
