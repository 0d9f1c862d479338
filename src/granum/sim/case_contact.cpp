// Reads [material.NAME] and [contact] with the properties of each pairing of materials.
#include "granum/sim/case_sections.hpp"
#include "granum/sim/law_families.hpp"

#include <algorithm>

namespace granum::sim
{
using io::Dimension;

namespace
{
constexpr io::Range poisson{.low = 0, .high = 0.5};

double modulus(io::CaseFile& file, std::string const& key, double fallback, char const* doc)
{
    return file.quantity(key, Dimension::pressure, fallback, doc, io::positive);
}

double number(io::CaseFile& file, std::string const& key, double fallback, char const* doc, io::Range range)
{
    return file.quantity(key, Dimension::one, fallback, doc, range);
}

//! A key that only one law reads is a mistake where another law is chosen.
bool belongs_to(io::CaseFile& file, std::string const& key, char const* slot, std::string const& chosen,
                char const* law)
{
    if (chosen == law) return true;
    if (file.has(key))
        file.mistake(key, fmt::format("has no meaning for {} = \"{}\"", slot, chosen),
                     {fmt::format("only {} = \"{}\" uses it: choose that law or leave the key out", slot, law)});
    file.know(key);
    return false;
}

//! True where granules are soft; of hard ones the key is a mistake.
bool for_soft(io::CaseFile& file, ContactCase const& contact, std::string const& key)
{
    return belongs_to(file, key, "contact.engine", contact.engine, "soft");
}

bool for_linear(io::CaseFile& file, ContactCase const& contact, std::string const& key)
{
    return for_soft(file, contact, key) && belongs_to(file, key, "contact.normal", contact.normal, "linear");
}

//! How two materials meet, from the keys with this beginning.
ContactPair read_pair(io::CaseFile& file, ContactCase const& contact, std::string const& prefix,
                      ContactPair const& fallback, char const* doc)
{
    ContactPair pair = fallback;
    pair.restitution = number(file, prefix + "restitution", fallback.restitution, doc, io::zero_to_one);
    pair.sliding_friction = number(file, prefix + "sliding_friction", fallback.sliding_friction, doc, io::not_negative);
    if (for_soft(file, contact, prefix + "rolling_friction"))
        pair.rolling_friction =
            number(file, prefix + "rolling_friction", fallback.rolling_friction, doc, io::not_negative);
    if (for_soft(file, contact, prefix + "rolling_damping") &&
        belongs_to(file, prefix + "rolling_damping", "contact.rolling", contact.rolling, "epsd-dashpot"))
        pair.rolling_damping =
            number(file, prefix + "rolling_damping", fallback.rolling_damping, doc, {.low = 0, .high = 10});
    if (contact.contact_time && !contact.hard() && file.has(prefix + "stiffness"))
        file.mistake(prefix + "stiffness", "does not go with contact.contact_time, which sets the stiffness",
                     {"leave one of the two out"});
    if (for_linear(file, contact, prefix + "stiffness"))
        pair.stiffness =
            file.quantity(prefix + "stiffness", Dimension::stiffness, fallback.stiffness, doc, io::positive);
    return pair;
}

//! What passes heat through contacts, from the keys with this beginning.
void read_conductor(io::CaseFile& file, ContactCase const& contact, std::string const& prefix, MaterialCase& material)
{
    if (contact.conducts()) {
        material.heat_conductivity =
            file.quantity(prefix + "heat_conductivity", Dimension::conductivity, material.heat_conductivity,
                          "of the solid; 0: passes no heat to what it touches", io::not_negative);
        material.real_youngs_modulus =
            file.optional_quantity(prefix + "real_youngs_modulus", Dimension::pressure,
                                   "not softened: heat passes the circle that the real granules have", io::positive)
                .value_or(material.real_youngs_modulus);
        return;
    }
    for (auto const& key : {prefix + "heat_conductivity", prefix + "real_youngs_modulus"}) {
        if (file.has(key))
            file.mistake(key, "has no meaning where contacts pass no heat",
                         {"choose contact.conduction = \"hertz\" or leave the key out"});
        file.know(key);
    }
}

//! Heat through contacts and through the gas beside them.
void read_heat_paths(io::CaseFile& file, ContactCase& contact)
{
    contact.conduction = file.name("contact.conduction", contact.conduction, "law, of heat through contacts",
                                   laws_for("contact.conduction"), "a law of heat conduction through contacts");
    contact.film = file.name("contact.film", contact.film, "law, of heat through the gas between surfaces",
                             laws_for("contact.film"), "a law of heat through the gas between granules");
    for (auto const* key : {"contact.conduction", "contact.film"})
        if (file.has(key) && !file.says(key, "none") && !file.has("gas"))
            file.mistake(key, "goes with gas: granules alone have no temperature", {"leave it out, or add [gas]"});
    auto const only_with = [&](bool chosen, char const* key, char const* what) {
        if (!chosen && file.has(key)) file.mistake(key, "has no meaning here", {what});
        file.know(key);
        return chosen;
    };
    char const* const choose_film = "choose contact.film = \"rong-horio\" or leave the key out";
    if (only_with(contact.films(), "contact.film_lens", choose_film))
        contact.film_lens = file.quantity("contact.film_lens", Dimension::one, contact.film_lens,
                                          "thickness of the gas that conducts, over the radius of the larger granule",
                                          {.low = 1e-3, .high = 0.5});
    if (only_with(contact.films(), "contact.film_shortest", choose_film))
        contact.film_shortest = file.quantity("contact.film_shortest", Dimension::length, contact.film_shortest,
                                              "way through the gas that is never undercut", io::positive);
    bool const hertz = contact.normal != "linear";
    if (only_with(contact.conducts() && hertz, "contact.collisions",
                  "choose contact.conduction = \"hertz\" and a Hertzian normal law, or leave the key out"))
        contact.collisions = file.boolean("contact.collisions", false,
                                          "contacts are collisions: heat passes for as long as real ones last");
}

//! The laws and the numbers that only some of them read.
void read_laws(io::CaseFile& file, ContactCase& contact)
{
    contact.engine =
        file.name("contact.engine", contact.engine, "soft: contacts last and overlap; hard: they are instants",
                  {"soft", "hard"}, "an engine");
    if (contact.hard())
        contact.tangential_restitution =
            file.quantity("contact.tangential_restitution", Dimension::one, contact.tangential_restitution,
                          "of the slip where surfaces stick", io::zero_to_one);
    else
        belongs_to(file, "contact.tangential_restitution", "contact.engine", contact.engine, "hard");
    for (auto const* key : {"contact.normal", "contact.tangential", "contact.rolling", "contact.lever_radius",
                            "contact.keep_attraction", "contact.reference_speed", "contact.tangential_ratio",
                            "contact.rigid_wall", "contact.conduction", "contact.film"})
        for_soft(file, contact, key);
    if (contact.hard()) {
        contact.contact_time =
            file.quantity("contact.contact_time", Dimension::time, 1e-6,
                          "a collision sooner than this after another of a granule is elastic", io::positive);
        return;
    }
    contact.normal =
        file.name("contact.normal", contact.normal, "law", laws_for("contact.normal"), "a normal contact law");
    contact.tangential = file.name("contact.tangential", contact.tangential, "law", laws_for("contact.tangential"),
                                   "a tangential contact law");
    contact.rolling =
        file.name("contact.rolling", contact.rolling, "law", laws_for("contact.rolling"), "a rolling contact law");
    read_heat_paths(file, contact);
    if (for_linear(file, contact, "contact.contact_time"))
        contact.contact_time =
            file.optional_quantity("contact.contact_time", Dimension::time,
                                   "of two of the smallest granules; sets the stiffnesses", io::positive);
    if (for_linear(file, contact, "contact.tangential_ratio"))
        contact.tangential_ratio = file.quantity("contact.tangential_ratio", Dimension::one, contact.tangential_ratio,
                                                 "tangential over normal stiffness", io::zero_to_one);
    if (belongs_to(file, "contact.reference_speed", "contact.normal", contact.normal, "hertz-viscoelastic"))
        contact.reference_speed =
            file.quantity("contact.reference_speed", Dimension::velocity, contact.reference_speed,
                          "at which two of the smallest granules have the given restitution", io::positive);
    contact.lever_radius = file.boolean("contact.lever_radius", false, "lever arm R instead of R - overlap/2");
    contact.keep_attraction =
        file.boolean("contact.keep_attraction", false, "keep the tensile end of a damped contact");
}

//! [[contact.pair]]: between = ["a", "b"] and what differs from the values of [contact].
void read_pairs(io::CaseFile& file, ContactCase& contact)
{
    auto const names = material_names(contact);
    std::vector<std::vector<int>> lines(names.size(), std::vector<int>(names.size(), -1));
    int const count = file.count("contact.pair");
    for (int i = 0; i < count; ++i) {
        auto const key = fmt::format("contact.pair[{}].", i);
        auto const between = file.list(key + "between", "the two materials", names);
        if (between.size() != 2) {
            if (!file.wrong(key + "between"))
                file.mistake(key + "between", "must name two materials",
                             {fmt::format("e.g. between = [\"{}\", \"{}\"]", names.front(), names.back())});
            continue;
        }
        auto a = material_number(contact, between[0]), b = material_number(contact, between[1]);
        if (a < b) std::swap(a, b);
        auto& pair = contact.pairs[a][b];
        pair = read_pair(file, contact, key, pair, "of this pairing");
        if (lines[a][b] >= 0)
            file.mistake(key + "between",
                         fmt::format("is stated already, in the {}. [[contact.pair]]", lines[a][b] + 1));
        lines[a][b] = i;
    }
}
}

std::vector<std::string> material_names(ContactCase const& contact)
{
    std::vector<std::string> out;
    for (auto const& material : contact.materials) out.push_back(material.name);
    return out;
}

std::uint32_t material_number(ContactCase const& contact, std::string const& name)
{
    auto const names = material_names(contact);
    return static_cast<std::uint32_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

void read_contact(io::CaseFile& file, Case& data)
{
    ContactCase& contact = data.contact;
    auto const own_names = file.names("material");
    bool const own_material = file.has("granules.material") &&
                              std::any_of(own_names.begin(), own_names.end(),
                                          [&](auto const& name) { return file.says("granules.material", name); });
    if (!own_material) take_material(file, "granules.material", {"granules", "contact"});
    read_laws(file, contact);
    MaterialCase granule{.name = "granule"}, wall{.name = "wall"};
    for (auto const* key : {"youngs_modulus", "poisson_ratio", "wall_youngs_modulus", "wall_poisson_ratio"})
        for_soft(file, contact, std::string("contact.") + key);
    if (!contact.hard()) {
        granule.youngs_modulus =
            modulus(file, "contact.youngs_modulus", granule.youngs_modulus, "of the granules, usually softened");
        granule.poisson_ratio =
            number(file, "contact.poisson_ratio", granule.poisson_ratio, "of the granules", poisson);
        wall.rigid = file.boolean("contact.rigid_wall", false, "walls do not yield");
        wall.youngs_modulus = modulus(file, "contact.wall_youngs_modulus", granule.youngs_modulus, "of the walls");
        wall.poisson_ratio = number(file, "contact.wall_poisson_ratio", granule.poisson_ratio, "of the walls", poisson);
    }
    read_conductor(file, contact, "contact.", granule);
    wall.heat_conductivity = granule.heat_conductivity;
    wall.real_youngs_modulus = granule.real_youngs_modulus;
    read_conductor(file, contact, "contact.wall_", wall);
    contact.materials = {granule, wall};
    for (auto const& name : own_names) {
        auto const key = "material." + name + ".";
        MaterialCase material{.name = name};
        material.density =
            file.optional_quantity(key + "density", Dimension::density, "of granules made of it", io::positive)
                .value_or(0);
        material.youngs_modulus =
            modulus(file, key + "youngs_modulus", granule.youngs_modulus, "usually softened; that of [contact]");
        material.poisson_ratio =
            number(file, key + "poisson_ratio", granule.poisson_ratio, "that of [contact]", poisson);
        material.rigid = file.boolean(key + "rigid", false, "does not yield");
        material.heat_conductivity = granule.heat_conductivity;
        material.real_youngs_modulus = granule.real_youngs_modulus;
        read_conductor(file, contact, key, material);
        if (name == "granule" || name == "wall")
            file.mistake("material." + name, "has a name that stands for the values of [contact] itself",
                         {"choose another name, or state them in [contact]"});
        contact.materials.push_back(material);
    }

    auto const own = read_pair(file, contact, "contact.", {}, "of granule on granule");
    auto const on_wall = read_pair(file, contact, "contact.wall_", own, "of granule on wall");
    contact.pairs.clear();
    for (std::size_t a = 0; a < contact.materials.size(); ++a) {
        contact.pairs.emplace_back(a + 1, own);
        if (a >= 1) contact.pairs[a][1] = on_wall;
    }
    read_pairs(file, contact);
    if (contact.collisions && std::any_of(contact.materials.begin(), contact.materials.end(),
                                          [](auto const& m) { return m.real_youngs_modulus == 0 && !m.rigid; }))
        file.mistake("contact.collisions", "needs the real modulus of every material",
                     {"add contact.real_youngs_modulus"});
    if (contact.conducts() && std::all_of(contact.materials.begin(), contact.materials.end(),
                                          [](auto const& m) { return m.heat_conductivity == 0; }))
        file.mistake("contact.heat_conductivity", "is missing: contacts are to pass heat",
                     {"e.g. heat_conductivity = \"0.3 W/m/K\" in [contact]"});
}
}
