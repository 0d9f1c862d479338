#include "granum/sim/wall_output.hpp"

#include "granum/geometry/region_walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace granum::sim
{
namespace
{
constexpr int pieces = 64;  // of a circle

//! Two unit vectors that make a right-handed frame with `axis`.
std::array<Vec3, 2> across(Vec3 const& axis)
{
    Vec3 const other = std::abs(axis.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
    Vec3 u = cross(other, axis);
    u = (1 / norm(u)) * u;
    return {u, cross(axis, u)};
}

//! A band of quadrangles between two circles about an axis; a circle of radius 0 is a point.
void add_band(io::Surface& out, Vec3 const& axis, Vec3 const& from, double from_radius, Vec3 const& to,
              double to_radius)
{
    auto const [u, v] = across(axis);
    int const first = static_cast<int>(out.corners.size());
    for (int k = 0; k < pieces; ++k) {
        double const angle = 2 * math::pi * k / pieces;
        Vec3 const direction = std::cos(angle) * u + std::sin(angle) * v;
        out.corners.push_back(from + from_radius * direction);
        out.corners.push_back(to + to_radius * direction);
        int const here = first + 2 * k, next = first + 2 * ((k + 1) % pieces);
        out.faces.push_back({here, next, next + 1, here + 1});
    }
}

//! Bands between circles of latitude.
void add_sphere(io::Surface& out, geometry::Sphere const& sphere)
{
    constexpr int bands = pieces / 2;
    Vec3 const axis{0, 0, 1};
    auto const angle = [](int k) { return math::pi * k / bands; };
    auto const radius = [&](int k) { return k == 0 || k == bands ? 0 : sphere.radius * std::sin(angle(k)); };
    auto const height = [&](int k) { return sphere.centre - sphere.radius * std::cos(angle(k)) * axis; };
    for (int k = 0; k < bands; ++k) add_band(out, axis, height(k), radius(k), height(k + 1), radius(k + 1));
}

void append(io::Surface& to, io::Surface const& one)
{
    int const shift = static_cast<int>(to.corners.size());
    to.corners.insert(to.corners.end(), one.corners.begin(), one.corners.end());
    for (auto face : one.faces) {
        for (int& corner : face) corner += shift;
        to.faces.push_back(std::move(face));
    }
}

void add(io::Surface& out, geometry::Shape const& shape)
{
    if (auto const* flank = std::get_if<geometry::Frustum>(&shape)) {
        add_band(out, flank->axis, flank->base, flank->base_radius, flank->base + flank->length * flank->axis,
                 flank->top_radius);
    } else if (auto const* disc = std::get_if<geometry::Disc>(&shape)) {
        add_band(out, disc->normal, disc->centre, disc->hole, disc->centre, disc->radius);
    } else if (auto const* sphere = std::get_if<geometry::Sphere>(&shape)) {
        add_sphere(out, *sphere);
    } else if (auto const* mesh = std::get_if<geometry::Mesh>(&shape)) {
        for (auto const& triangle : mesh->triangles) {
            int const first = static_cast<int>(out.corners.size());
            out.corners.insert(out.corners.end(), triangle.begin(), triangle.end());
            out.faces.push_back({first, first + 1, first + 2});
        }
    }
}
}

io::Surface body_surface(geometry::Body const& body, geometry::Pose const& pose)
{
    io::Surface out;
    for (auto const& shape : body.shapes) add(out, shape);
    for (auto& corner : out.corners) corner = pose.to_space(corner);
    return out;
}

io::Surface chamber_walls(Case const& data)
{
    auto const& region = data.chamber.region;
    io::Surface out;
    if (data.chamber.shape != geometry::Chamber::Shape::solids) out = io::chamber_surface(data.chamber);
    for (auto body : data.bodies) {
        // Planes have no ends: what they bound is drawn instead.
        auto const plane = [](auto const& shape) { return std::holds_alternative<geometry::Plane>(shape); };
        if (std::any_of(body.shapes.begin(), body.shapes.end(), plane))
            for (std::size_t k = 0; k < region->solids(); ++k)
                if (region->name(k) == body.name) body.shapes = geometry::surface_shapes(region->solid(k), false);
        append(out, body_surface(body, {}));
    }
    return out;
}

WallOutput::WallOutput(std::string folder, Simulation& simulation)
    : folder_(std::move(folder)), simulation_(simulation), surfaces_(folder_ + "/case_walls.pvd")
{
    auto const& own = simulation_.data().walls;
    moving_ = std::any_of(own.begin(), own.end(), [](auto const& body) { return !body.motions.empty(); });
    if (!simulation_.comm().root()) return;
    std::vector<io::SeriesColumn> columns{{"time", "s"}};
    for (auto const& body : simulation_.mover().settings().walls)
        for (auto const* what : {"force", "torque"})
            for (char const axis : {'x', 'y', 'z'})
                columns.push_back({fmt::format("{}_{}_{}", body.name, what, axis), what[0] == 'f' ? "N" : "N m"});
    loads_ = {folder_ + "/walls.csv", "walls", columns};
}

void WallOutput::sample()
{
    auto const loads = simulation_.mover().wall_loads();
    if (!loads_.writes()) return;
    std::vector<double> row{simulation_.time()};
    for (auto const& [force, torque] : loads)
        row.insert(row.end(), {force.x, force.y, force.z, torque.x, torque.y, torque.z});
    loads_.append(row);
}

void WallOutput::save(io::Sections& out) const
{
    std::string const& entries = surfaces_.entries();
    loads_.save(out);
    out.push_back(io::section_of("output.wall_surfaces", std::vector<char>(entries.begin(), entries.end())));
}

void WallOutput::go_on(io::Sections const& saved)
{
    loads_.go_on(saved);
    auto const entries = io::values_of<char>(io::find_section(saved, "output.wall_surfaces"));
    if (!entries.empty()) surfaces_.go_on({entries.begin(), entries.end()});
}

void WallOutput::picture(int number)
{
    auto const& own = simulation_.data().walls;
    if (!loads_.writes() || own.empty() || (number > 0 && !moving_)) return;
    auto const& mover = simulation_.mover();
    std::size_t const first = mover.settings().walls.size() - own.size();  // those of the chamber come before
    io::Surface all;
    for (std::size_t k = 0; k < own.size(); ++k) append(all, body_surface(own[k], mover.pose(first + k)));
    auto const name = fmt::format("vtk/case_walls_{:06d}.vtp", number);
    io::write_surface(folder_ + "/" + name, all);
    surfaces_.add(simulation_.time(), name);
}
}
