// Reads [[apparatus.solid]], solids that make a chamber, and [[internal]], bodies that stand in a chamber.
#include "granum/base/error.hpp"
#include "granum/geometry/bodies_in_chamber.hpp"
#include "granum/geometry/region_walls.hpp"
#include "granum/sim/case_sections.hpp"
#include "granum/sim/case_solid.hpp"

#include <algorithm>
#include <set>

namespace granum::sim
{
using geometry::Bounds;
using geometry::Depth;
using geometry::Region;
using io::Dimension;

namespace
{
constexpr double noticed = 1e-4;           // of a body's size: an overlap
constexpr double together = 1e-6;          // of the sizes: what is as near touches
constexpr double resolutions = 1.0 / 150;  // of the size of the apparatus

Depth depth_in(geometry::Solid const& solid)
{
    return [&solid](Vec3 const& x) { return -geometry::surface_distance(solid, x).distance; };
}

Depth depth_in(Region const& region)
{
    return [&region](Vec3 const& x) { return region.distance(x); };
}

//! The box in which two bodies may meet, with room for what only touches.
Bounds common(Bounds const& one, Bounds const& other, double room)
{
    Bounds box = geometry::overlap(one, other);
    for (std::size_t d = 0; d < 3; ++d) box.lower[d] -= room, box.upper[d] += room;
    return box;
}

Bounds bounds_of(Region const& region)
{
    return {region.lower(), region.upper()};
}

std::string place(Vec3 const& x)
{
    return fmt::format("({:.4g}, {:.4g}, {:.4g}) m", x.x, x.y, x.z);
}

std::string extent(Bounds const& box)
{
    return fmt::format("from {} to {}", place(box.lower), place(box.upper));
}

//! A name that walls of gas and columns of walls.csv can have.
std::string read_name(io::CaseFile& file, std::string const& key, std::string const& fallback,
                      std::set<std::string>& taken)
{
    auto const name = file.words(key + "name", fallback, "of the wall in results and in gas.wall.of");
    check_column_name(file, key + "name", name);
    if (!taken.insert(name).second) file.mistake(key + "name", "is that of another wall too");
    return name;
}

std::set<std::string> names_of_walls()
{
    std::set<std::string> out{"all", "chamber"};
    out.insert(end_names().begin(), end_names().end());
    return out;
}

//! The walls of the region for granules; a mistake where they cannot be drawn.
void draw(io::CaseFile& file, std::string const& key, Region const& region, double resolution, std::uint32_t material,
          std::vector<geometry::Body>& out)
{
    try {
        for (auto& body : geometry::wall_bodies(region, resolution)) {
            body.material = material;
            out.push_back(std::move(body));
        }
    } catch (base::CaseError const& error) {
        file.mistake(file.has("apparatus.resolution") ? "apparatus.resolution" : key,
                     "cannot be drawn as a wall for granules: it " + error.mistakes.front().what,
                     {fmt::format("walls are drawn to {:.3g} mm: give apparatus.resolution half of the thinnest wall",
                                  1e3 * resolution)});
    }
}

void read_resolution(io::CaseFile& file, double size, Case& data)
{
    data.resolution = file.quantity("apparatus.resolution", Dimension::length, resolutions * size,
                                    "to which walls of joined bodies are drawn for granules", io::positive);
}

//! Adds a solid to the chamber so far, takes it away, or leaves what both have; a mistake where it does not meet it.
void combine(io::CaseFile& file, std::string const& key, std::string const& operation, Region solid,
             std::optional<Region>& open)
{
    if (!open) {
        if (operation != "add")
            file.mistake(key + "operation", "comes before there is a chamber", {"the first solid is added"});
        open = std::move(solid);
        return;
    }
    Bounds const own = bounds_of(solid), before = bounds_of(*open);
    double const room = together * std::max(own.size(), before.size());
    bool const add = operation == "add";
    auto const met = geometry::common_place(depth_in(solid), depth_in(*open), common(own, before, room),
                                            add ? -room : noticed * std::min(own.size(), before.size()));
    if (!met) {
        file.mistake(key + "operation",
                     add                       ? "adds a body that does not touch what was added before"
                     : operation == "subtract" ? "takes away a body that does not reach into what was added before"
                                               : "leaves nothing: the body does not reach into what was added before",
                     {"it reaches " + extent(own), "the chamber before it reaches " + extent(before)});
        return;
    }
    open = add ? *open | solid : operation == "subtract" ? *open - solid : *open & solid;
}

struct Internal
{
    std::string key, name;
    geometry::Solid solid;
    std::uint32_t material;
    bool joined;
    std::size_t group;
};

//! The table whose keys begin with `key`.
std::string table(std::string const& key)
{
    return key.substr(0, key.size() - 1);
}

//! Bodies that overlap are one group if that is meant, else a mistake.
void group(io::CaseFile& file, std::vector<Internal>& bodies)
{
    for (std::size_t k = 0; k < bodies.size(); ++k) bodies[k].group = k;
    for (std::size_t k = 0; k < bodies.size(); ++k)
        for (std::size_t j = 0; j < k; ++j) {
            auto &one = bodies[j], &other = bodies[k];
            Bounds const first = geometry::bounds(one.solid), second = geometry::bounds(other.solid);
            double const least = noticed * std::min(first.size(), second.size());
            auto const met = geometry::common_place(depth_in(one.solid), depth_in(other.solid),
                                                    geometry::overlap(first, second), least);
            if (!met) continue;
            auto const key = table(other.key);
            if (!one.joined && !other.joined)
                file.mistake(key, fmt::format("overlaps \"{}\", about {}", one.name, place(*met)),
                             {"move one of them, or give joined = true where they are fixed to each other"});
            else if (one.material != other.material)
                file.mistake(other.key + "material",
                             fmt::format("is not that of \"{}\", which it is joined to", one.name));
            std::size_t const from = other.group, to = one.group;
            for (auto& body : bodies)
                if (body.group == from) body.group = to;
        }
}

//! Whether a body stands in the chamber, in part at least.
bool stands_within(io::CaseFile& file, Internal const& body, geometry::Chamber const& chamber)
{
    Bounds const own = geometry::bounds(body.solid), around{chamber.lower(), chamber.upper()};
    Region const open = chamber.region ? *chamber.region : Region("chamber", chamber);
    double const least = noticed * std::min(own.size(), around.size());
    if (geometry::common_place(depth_in(body.solid), depth_in(open), geometry::overlap(own, around), least))
        return true;
    file.mistake(table(body.key), "does not stand in the apparatus",
                 {"it reaches " + extent(own), "the apparatus reaches " + extent(around)});
    return false;
}
}

void read_solids(io::CaseFile& file, Case& data)
{
    int const count = file.count("apparatus.solid");
    bool const wanted = data.chamber.shape == geometry::Chamber::Shape::solids;
    if (!wanted) {
        if (count > 0 && !file.wrong("apparatus.shape"))
            file.mistake("apparatus.solid", "belongs to shape = \"solids\"",
                         {"a body that stands in the chamber is an [[internal]]"});
        return;
    }
    if (count == 0) {
        file.mistake("apparatus.solid", "is missing", {"one [[apparatus.solid]] at least, with its shape"});
        return;
    }
    std::optional<Region> open;
    bool good = true;
    auto taken = names_of_walls();
    for (int k = 0; k < count; ++k) {
        auto const key = fmt::format("apparatus.solid[{}].", k);
        auto const name = read_name(file, key, fmt::format("solid-{}", k), taken);
        auto const operation = file.name(key + "operation", "add", "what it does to the chamber before it",
                                         {"add", "subtract", "intersect"}, "an operation");
        auto solid = read_solid(file, key, 0);
        good = good && solid && !file.wrong(key + "operation");
        if (good) combine(file, key, operation, Region(name, std::move(*solid)), open);
        good = good && !file.wrong(key + "operation");
    }
    if (!good) return;
    read_resolution(file, open->size(), data);
    auto chamber = geometry::chamber_of(*open);
    if (!(chamber.volume() > 0)) {
        file.mistake("apparatus.solid", "leaves nothing open", {"the bodies taken away fill those added"});
        return;
    }
    draw(file, "apparatus.solid", *open, data.resolution, 1, data.bodies);
    data.chamber = std::move(chamber);
    file.derived("chamber.extent", extent({data.chamber.lower(), data.chamber.upper()}), "of the chamber");
    file.derived("chamber.volume", fmt::format("{:.5g} L", 1e3 * data.chamber.volume()), "open to gas and granules");
}

void read_internals(io::CaseFile& file, Case& data)
{
    int const count = file.count("internal");
    bool const solids = data.chamber.shape == geometry::Chamber::Shape::solids;
    bool const known = data.chamber.known() && file.has("apparatus") && !file.wrong("apparatus.shape") &&
                       !file.wrong("apparatus.size") && !file.wrong("apparatus.profile");
    if (count > 0 && (data.periodic[0] || data.periodic[1] || data.periodic[2]))
        file.mistake("internal", "does not go with apparatus.periodic: bodies do not repeat themselves",
                     {"close the box, or leave the bodies out"});
    double const size = known ? math::norm(data.chamber.upper() - data.chamber.lower()) : 0;
    auto taken = names_of_walls();
    if (data.chamber.region)
        for (std::size_t k = 0; k < data.chamber.region->solids(); ++k) taken.insert(data.chamber.region->name(k));
    std::vector<Internal> bodies;
    for (int k = 0; k < count; ++k) {
        auto const key = fmt::format("internal[{}].", k);
        auto const name = read_name(file, key, fmt::format("internal-{}", k), taken);
        auto const material = read_material(file, data.contact, key + "material", 1, "it is made of");
        bool const joined = file.boolean(key + "joined", false, "it may overlap other bodies that it is fixed to");
        auto solid = read_solid(file, key, size);
        if (solid) bodies.push_back({key, name, std::move(*solid), material, joined, 0});
    }
    if (!solids && count == 0) file.know("apparatus.resolution");
    if (count == 0 || !known) return;
    std::erase_if(bodies, [&](auto const& body) { return !stands_within(file, body, data.chamber); });
    group(file, bodies);
    if (!solids) read_resolution(file, size, data);
    std::vector<Region> regions;
    for (auto const& body : bodies) regions.emplace_back(body.name, body.solid);
    for (std::size_t first = 0; first < bodies.size(); ++first) {
        std::vector<std::size_t> members;
        for (std::size_t k = 0; k < bodies.size(); ++k)
            if (bodies[k].group == first) members.push_back(k);
        if (members.size() == 1) {
            auto const& body = bodies[members[0]];
            data.bodies.push_back(
                {.name = body.name, .shapes = geometry::surface_shapes(body.solid, false), .material = body.material});
        } else if (!members.empty()) {
            Region filled = regions[members[0]];
            for (std::size_t k = 1; k < members.size(); ++k) filled = filled | regions[members[k]];
            draw(file, table(bodies[members[0]].key), ~filled, data.resolution, bodies[members[0]].material,
                 data.bodies);
        }
    }
    data.chamber = geometry::with_bodies(std::move(data.chamber), regions);
    if (!(data.chamber.volume() > 0)) file.mistake("internal", "leaves nothing of the apparatus open");
}
}
