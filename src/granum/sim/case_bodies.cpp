// The mistakes that show where openings and nozzles meet the solids of an apparatus and the bodies in it.
#include "granum/geometry/bodies_in_chamber.hpp"
#include "granum/sim/case_sections.hpp"
#include "granum/sim/opening_area.hpp"

#include <algorithm>
#include <cmath>

namespace granum::sim
{
namespace
{
constexpr double hidden = 1e-3;  // of an opening, or of its end: what is left free of it is nothing

std::string name_of_end(OpeningCase const& at)
{
    return end_names()[2 * at.direction + (at.upper ? 1 : 0)];
}

//! The solid that covers the middle of an opening.
std::string cover(geometry::Chamber const& chamber, OpeningCase const& at)
{
    Vec3 const low = chamber.lower(), high = chamber.upper();
    Vec3 middle = at.round ? at.centre : 0.5 * (low + high);
    if (at.rectangle) middle = 0.5 * (at.rectangle->lower + at.rectangle->upper);
    double const depth = 1e-6 * (high[at.direction] - low[at.direction]);
    middle[at.direction] = at.upper ? high[at.direction] - depth : low[at.direction] + depth;
    return chamber.region->name(chamber.region->nearest_solid(middle));
}

//! A box in which granules are to appear.
void check_place(io::CaseFile& file, geometry::Chamber const& chamber, std::string const& key, RegionCase const& box)
{
    if (file.wrong(key + ".lower") || file.wrong(key + ".upper")) return;
    geometry::Solid const own = geometry::Box{box.lower, box.upper};
    auto const open =
        geometry::common_place([&](Vec3 const& x) { return -geometry::surface_distance(own, x).distance; },
                               [&](Vec3 const& x) { return chamber.region->distance(x); }, {box.lower, box.upper}, 0);
    if (open) return;
    Vec3 const middle = 0.5 * (box.lower + box.upper);
    file.mistake(key, "has no open place: its middle is " + where_in_bodies(chamber, middle),
                 {"give lower and upper corners around the place where granules shall appear"});
}

void check_opening(io::CaseFile& file, Case const& data, std::string const& key, char const* kind,
                   OpeningCase const& at)
{
    for (auto const* part : {"end", "lower", "upper", "diameter", "hole", "centre"})
        if (file.wrong(fmt::format("{}.{}", key, part))) return;
    auto const& chamber = data.chamber;
    auto const area = opening_area(data, at);
    if (area.free > hidden * area.nominal) return;
    auto const where = file.has(key + ".diameter") ? key + ".diameter"
                       : file.has(key + ".end")    ? key + ".end"
                       : file.has(key)             ? key
                                                   : "gas";
    bool const whole = !at.round && !at.rectangle;
    auto const end = name_of_end(at);
    std::size_t const d = at.direction;
    double const place = at.upper ? chamber.upper()[d] : chamber.lower()[d];
    std::string const plane = fmt::format("{} = {:.4g} mm", "xyz"[d], 1e3 * place);
    if (whole)
        file.mistake(where, fmt::format("leaves no {}: nothing of the end \"{}\" is open, at {}", kind, end, plane),
                     {"an opening lies in an end of the box around the apparatus: let a solid reach there with a flat "
                      "end, a duct for example",
                      fmt::format("nearest to its middle is \"{}\"", cover(chamber, at))});
    else
        file.mistake(where,
                     fmt::format("is hidden: \"{}\" covers all of the {} at {}", cover(chamber, at), kind, plane),
                     {"move the opening to where the end of the apparatus is open, or move the body"});
}
}

void check_against_bodies(io::CaseFile& file, Case const& data)
{
    if (!data.chamber.region) return;
    if (data.granules.region) check_place(file, data.chamber, "granules.region", *data.granules.region);
    for (std::size_t k = 0; k < data.feeds.size(); ++k)
        check_place(file, data.chamber, fmt::format("feed[{}]", k), data.feeds[k].region);
    if (!data.gas.present) return;
    bool const told = file.has("inlet") || file.has("outlet");
    for (std::size_t k = 0; k < data.gas.inlets.size(); ++k)
        check_opening(file, data, told ? fmt::format("inlet[{}]", k) : "gas", "inlet", data.gas.inlets[k].at);
    for (std::size_t k = 0; k < data.gas.outlets.size(); ++k)
        check_opening(file, data, told ? fmt::format("outlet[{}]", k) : "gas", "outlet", data.gas.outlets[k].at);
}

std::string where_in_bodies(geometry::Chamber const& chamber, Vec3 const& x)
{
    if (!chamber.region) return "outside the chamber";
    auto const wall = chamber.region->at(x);
    auto const& name = chamber.region->name(wall.solid);
    bool const around = chamber.region->open_inside(wall.solid);
    return fmt::format("{} \"{}\", {:.3g} mm from where it is open", around ? "outside" : "in the wall: within", name,
                       1e3 * std::abs(wall.distance));
}
}
