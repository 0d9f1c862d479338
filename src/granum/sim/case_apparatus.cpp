// Reads [apparatus], [granules], [[granule]] and [contact].
#include "granum/sim/case_sections.hpp"
#include "granum/sim/law_families.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace granum::sim
{
using io::Dimension;

void read_apparatus(io::CaseFile& file, Case& data, Purpose purpose)
{
    if (purpose == Purpose::balance && !file.has("apparatus")) return;
    auto const shape = file.name("apparatus.shape", std::nullopt, "\"box\" or \"revolution\" (round, about the z axis)",
                                 {"box", "revolution"}, "a shape");
    bool const box = shape == "box";
    data.chamber.shape = box ? geometry::Chamber::Shape::box : geometry::Chamber::Shape::revolution;
    if (box || file.has("apparatus.size")) {
        data.chamber.size =
            file.vector("apparatus.size", Dimension::length, std::nullopt, "width, depth and height of a box");
        for (std::size_t i = 0; i < 3; ++i)
            if (!file.wrong("apparatus.size") && !(data.chamber.size[i] > 0))
                file.mistake("apparatus.size", "has a side that is not longer than 0");
        if (!box && !file.wrong("apparatus.shape")) file.mistake("apparatus.size", "belongs to shape = \"box\"");
    } else {
        file.know("apparatus.size");
    }
    for (auto const& axis :
         file.list("apparatus.periodic", "directions in which a box repeats itself", {"x", "y", "z"}))
        data.periodic[static_cast<std::size_t>(axis[0] - 'x')] = true;
    if (!box && (data.periodic[0] || data.periodic[1] || data.periodic[2]))
        file.mistake("apparatus.periodic", "belongs to shape = \"box\"");

    auto const rows =
        file.table("apparatus.profile", 2, Dimension::length, "rows of height and diameter, from the plate up");
    if (box && !rows.empty()) file.mistake("apparatus.profile", "belongs to shape = \"revolution\"");
    if (shape != "revolution") return;
    if (!file.has("apparatus.profile"))
        file.mistake("apparatus.profile", "is missing",
                     {"rows of height and diameter, e.g. [[\"0 mm\", \"180 mm\"], [\"1 m\", \"180 mm\"]]"});
    for (std::size_t i = 0; i < rows.size(); ++i) {
        bool const rises = i == 0 ? rows[0][0] == 0 : rows[i][0] > rows[i - 1][0];
        if (!rises) {
            file.mistake("apparatus.profile", "must begin at height 0 and rise from row to row");
            break;
        }
        if (!(rows[i][1] > 0)) {
            file.mistake("apparatus.profile", "has a diameter that is not above 0");
            break;
        }
        data.chamber.profile.push_back({rows[i][0], rows[i][1] / 2});
    }
    if (rows.size() == 1 && !file.wrong("apparatus.profile"))
        file.mistake("apparatus.profile", "needs at least two rows: the plate and the outlet");
}

namespace
{
//! Columns of a CSV file of granules, SI: id,x,y,z,radius and then, if there, vx,vy,vz,wx,wy,wz.
void read_granule_file(io::CaseFile& file, std::string const& key, std::string const& name, GranulesCase& granules)
{
    auto const path = std::filesystem::path(file.path()).parent_path() / name;
    std::ifstream in(path);
    if (!in) {
        file.mistake(key, fmt::format("cannot be opened ({})", path.string()),
                     {"the path is relative to the case file"});
        return;
    }
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
        if (line.empty() || line[0] == '#' || std::isalpha(static_cast<unsigned char>(line[0]))) continue;
        std::vector<double> values;
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');) {
            char* end = nullptr;
            values.push_back(std::strtod(cell.c_str(), &end));
            if (end == cell.c_str()) values.back() = std::nan("");
        }
        bool const good = (values.size() == 5 || values.size() == 8 || values.size() == 11) &&
                          std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }) &&
                          values[4] > 0;
        if (!good) {
            file.mistake(key, fmt::format("line {} of {} is not a granule", number, path.string()),
                         {"columns: id,x,y,z,radius[,vx,vy,vz[,wx,wy,wz]] in m, m/s and rad/s"});
            return;
        }
        values.resize(11, 0.0);
        granules.given.push_back({.position = {values[1], values[2], values[3]},
                                  .velocity = {values[5], values[6], values[7]},
                                  .spin = {values[8], values[9], values[10]},
                                  .diameter = 2 * values[4]});
    }
}

void read_given(io::CaseFile& file, GranulesCase& granules)
{
    if (auto const name =
            file.words("granules.file", "", "CSV file of granules: id,x,y,z,radius[,vx,vy,vz[,wx,wy,wz]], SI");
        !name.empty())
        read_granule_file(file, "granules.file", name, granules);
    int const count = file.count("granule");
    for (int i = 0; i < count; ++i) {
        auto const key = fmt::format("granule[{}].", i);
        GranuleCase one;
        one.position = file.vector(key + "position", Dimension::length, std::nullopt, "centre");
        one.velocity = file.vector(key + "velocity", Dimension::velocity, math::Vec3{}, "at the start");
        one.spin = file.vector(key + "spin", Dimension::angular_speed, math::Vec3{}, "at the start");
        one.diameter =
            file.optional_quantity(key + "diameter", Dimension::length, "instead of that of [granules]", io::positive)
                .value_or(granules.diameter);
        one.density =
            file.optional_quantity(key + "density", Dimension::density, "instead of that of [granules]", io::positive)
                .value_or(0);
        granules.given.push_back(one);
    }
}
}

void read_granules(io::CaseFile& file, Case& data, Purpose purpose)
{
    GranulesCase& granules = data.granules;
    if (!file.has("granules") && !file.has("granule")) return;
    take_material(file, "granules.material", {"granules", "contact"});
    bool const needed = purpose == Purpose::run;
    auto const or_default = [needed](double value) { return needed ? std::nullopt : std::optional(value); };
    granules.diameter = file.quantity("granules.diameter", Dimension::length, or_default(granules.diameter),
                                      "of a granule", io::positive);
    granules.density = file.quantity("granules.density", Dimension::density, or_default(granules.density),
                                     "of a granule", io::positive);
    granules.heat_capacity = file.quantity("granules.heat_capacity", Dimension::heat_capacity, granules.heat_capacity,
                                           "of the dry granule", io::positive);
    granules.frozen = file.boolean("granules.frozen", false, "granules stay where they are (fixed bed)");
    read_given(file, granules);

    auto const mass = file.optional_quantity("granules.mass", Dimension::mass, "of the batch", io::positive);
    auto const ratio = file.optional_quantity("granules.parcel_ratio", Dimension::one,
                                              "a parcel stands for ratio^3 granules", io::Range{.low = 1});
    bool const counted = file.has("granules.parcels");
    long const parcels =
        file.integer("granules.parcels", 0, "number of parcels (instead of parcel_ratio)", 1, 100'000'000);
    granules.start =
        file.name("granules.start", granules.given.empty() ? "settled" : "given", "how the granules lie at the start",
                  {"settled", "loose", "lattice", "given"}, "a start");
    if (ratio && counted) file.mistake("granules.parcels", "and granules.parcel_ratio cannot both be given");

    if (!granules.given.empty()) {
        if (mass) file.mistake("granules.mass", "cannot be given where granules are given one by one");
        if (counted) file.mistake("granules.parcels", "cannot be given where granules are given one by one");
        granules.parcel_ratio = ratio.value_or(1);
        granules.parcels = static_cast<long>(granules.given.size());
        return;
    }
    if (granules.start == "given" && !file.wrong("granules.start"))
        file.mistake("granules.start", "needs granules.file or [[granule]] tables");
    if (!mass) {
        if (needed && !file.wrong("granules.mass") && !file.has("granules.file") && !file.has("granule"))
            file.mistake("granules.mass", "is missing", {"the batch, e.g. \"1 kg\""});
        return;
    }
    granules.mass = *mass;
    double const one = granules.density * math::pi / 6 * std::pow(granules.diameter, 3);
    double const represented = granules.mass / one;
    if (!std::isfinite(represented)) return;
    granules.parcel_ratio =
        counted ? std::max(1.0, std::cbrt(represented / static_cast<double>(parcels))) : ratio.value_or(1);
    granules.parcels = counted && granules.parcel_ratio > 1
                           ? parcels
                           : std::max(1L, std::lround(represented / std::pow(granules.parcel_ratio, 3)));
    if (counted)
        file.derived("granules.parcel_ratio", fmt::format("{:.4g}", granules.parcel_ratio),
                     "a parcel stands for ratio^3 granules");
    else
        file.derived("granules.parcels", fmt::format("{}", granules.parcels), "number of parcels");
}

namespace
{
//! A key that only one law reads is a mistake where another law is chosen.
bool belongs_to(io::CaseFile& file, char const* key, char const* slot, std::string const& chosen, char const* law)
{
    if (chosen == law) return true;
    if (file.has(key))
        file.mistake(key, fmt::format("has no meaning for {} = \"{}\"", slot, chosen),
                     {fmt::format("only {} = \"{}\" uses it: choose that law or leave the key out", slot, law)});
    file.know(key);
    return false;
}

void read_law_parameters(io::CaseFile& file, ContactCase& contact)
{
    auto& own = contact.granule_granule;
    auto& wall = contact.granule_wall;
    auto const linear = [&](char const* key) {
        return belongs_to(file, key, "contact.normal", contact.normal, "linear");
    };
    if (linear("contact.contact_time"))
        contact.contact_time =
            file.optional_quantity("contact.contact_time", Dimension::time,
                                   "of two of the smallest granules; sets the stiffnesses", io::positive);
    for (auto const* key : {"contact.stiffness", "contact.wall_stiffness"})
        if (contact.contact_time && file.has(key))
            file.mistake(key, "does not go with contact.contact_time, which sets the stiffness",
                         {"leave one of the two out"});
    if (linear("contact.stiffness"))
        own.stiffness = file.quantity("contact.stiffness", Dimension::stiffness, own.stiffness,
                                      "of granule on granule, normal", io::positive);
    if (linear("contact.wall_stiffness"))
        wall.stiffness = file.quantity("contact.wall_stiffness", Dimension::stiffness, own.stiffness,
                                       "of granule on wall, normal", io::positive);
    if (linear("contact.tangential_ratio"))
        contact.tangential_ratio = file.quantity("contact.tangential_ratio", Dimension::one, contact.tangential_ratio,
                                                 "tangential over normal stiffness", io::zero_to_one);
    if (belongs_to(file, "contact.reference_speed", "contact.normal", contact.normal, "hertz-viscoelastic"))
        contact.reference_speed =
            file.quantity("contact.reference_speed", Dimension::velocity, contact.reference_speed,
                          "at which two of the smallest granules have the given restitution", io::positive);
    io::Range const damping{.low = 0, .high = 10};
    auto const dashpot = [&](char const* key) {
        return belongs_to(file, key, "contact.rolling", contact.rolling, "epsd-dashpot");
    };
    if (dashpot("contact.rolling_damping"))
        own.rolling_damping = file.quantity("contact.rolling_damping", Dimension::one, own.rolling_damping,
                                            "of granule on granule, over critical damping", damping);
    if (dashpot("contact.wall_rolling_damping"))
        wall.rolling_damping = file.quantity("contact.wall_rolling_damping", Dimension::one, own.rolling_damping,
                                             "of granule on wall, over critical damping", damping);
}
}

void read_contact(io::CaseFile& file, Case& data)
{
    ContactCase& contact = data.contact;
    auto const modulus = [&](char const* key, double fallback, char const* doc) {
        return file.quantity(key, Dimension::pressure, fallback, doc, io::positive);
    };
    auto const number = [&](char const* key, double fallback, char const* doc, io::Range range) {
        return file.quantity(key, Dimension::one, fallback, doc, range);
    };
    contact.normal =
        file.name("contact.normal", contact.normal, "law", laws_for("contact.normal"), "a normal contact law");
    contact.tangential = file.name("contact.tangential", contact.tangential, "law", laws_for("contact.tangential"),
                                   "a tangential contact law");
    contact.rolling =
        file.name("contact.rolling", contact.rolling, "law", laws_for("contact.rolling"), "a rolling contact law");
    io::Range const poisson{.low = 0, .high = 0.5};
    contact.granule.youngs_modulus =
        modulus("contact.youngs_modulus", contact.granule.youngs_modulus, "of the granules, usually softened");
    contact.granule.poisson_ratio =
        number("contact.poisson_ratio", contact.granule.poisson_ratio, "of the granules", poisson);
    contact.rigid_wall = file.boolean("contact.rigid_wall", false, "walls do not yield");
    contact.wall.youngs_modulus =
        modulus("contact.wall_youngs_modulus", contact.granule.youngs_modulus, "of the walls");
    contact.wall.poisson_ratio =
        number("contact.wall_poisson_ratio", contact.granule.poisson_ratio, "of the walls", poisson);
    auto& own = contact.granule_granule;
    own.restitution = number("contact.restitution", own.restitution, "of granule on granule", io::zero_to_one);
    own.sliding_friction =
        number("contact.sliding_friction", own.sliding_friction, "of granule on granule", io::not_negative);
    own.rolling_friction =
        number("contact.rolling_friction", own.rolling_friction, "of granule on granule", io::not_negative);
    auto& wall = contact.granule_wall;
    wall.restitution = number("contact.wall_restitution", own.restitution, "of granule on wall", io::zero_to_one);
    wall.sliding_friction =
        number("contact.wall_sliding_friction", own.sliding_friction, "of granule on wall", io::not_negative);
    wall.rolling_friction =
        number("contact.wall_rolling_friction", own.rolling_friction, "of granule on wall", io::not_negative);
    contact.lever_radius = file.boolean("contact.lever_radius", false, "lever arm R instead of R - overlap/2");
    contact.keep_attraction =
        file.boolean("contact.keep_attraction", false, "keep the tensile end of a damped contact");
    read_law_parameters(file, contact);
}
}
