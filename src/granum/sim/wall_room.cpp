#include "granum/sim/wall_room.hpp"

namespace granum::sim
{
WallRoom::WallRoom(Case const& data) : chamber_(data.chamber)
{
    for (auto const& body : data.walls) bodies_.emplace_back(body);
}

bool WallRoom::operator()(Vec3 const& centre, double radius)
{
    if (!chamber_.inside(centre, radius)) return false;
    for (auto const& body : bodies_) {
        facets_.clear();
        body.near(centre, radius, facets_);
        std::array<geometry::Nearest, geometry::most_touches> touches;
        if (body.touches(centre, radius, facets_, scratch_, touches) > 0) return false;
    }
    return true;
}
}
