// What hard spheres need of a case: granules alone, at places without overlaps, between walls at rest that they know.
#include "granum/base/error.hpp"
#include "granum/dem/hard_walls.hpp"
#include "granum/sim/build.hpp"
#include "granum/sim/case_sections.hpp"

#include <cmath>

namespace granum::sim
{
namespace
{
std::string const soft_hint = "or choose contact.engine = \"soft\"";

//! Where the granules of a case are stated.
std::string granules_key(io::CaseFile const& file)
{
    for (auto const* key : {"granules.file", "granules.run", "granule"})
        if (file.has(key)) return key;
    return "granules";
}

//! What the engine itself would refuse at its start, of granules given one by one.
void check_start(io::CaseFile& file, Case const& data)
{
    if (data.granules.given.empty()) return;
    particle::Store granules;
    granules.keep({.parcel = false, .gas = false, .process = false});
    for (auto one : data.granules.given) {
        one.density = density_of(data, one);
        add_granule(granules, one);
    }
    granules.owned = granules.rows();
    try {
        dem::HardSpheres(granule_settings(data), hard_options(data)).prepare(granules);
    } catch (base::NumericsError const& error) {
        file.mistake(granules_key(file), fmt::format("is no start for hard spheres: {}", error.what()),
                     {"allowed: overlaps up to 1e-9 of a radius", soft_hint});
    }
}
}

void check_hard_spheres(io::CaseFile& file, Case const& data)
{
    if (!data.contact.hard()) return;
    if (data.gas.present || file.has("gas"))
        file.mistake("gas", "does not go with contact.engine = \"hard\", which moves granules alone",
                     {"leave out [gas]", soft_hint});
    if (file.has("feed"))
        file.mistake("feed", "does not go with contact.engine = \"hard\": all granules are there from the start",
                     {"leave it out", soft_hint});
    if (file.has("apparatus.open"))
        file.mistake("apparatus.open", "does not go with contact.engine = \"hard\": none may leave",
                     {"leave it out", soft_hint});
    if (data.granules.start == "settled" || data.granules.start == "poured")
        file.mistake("granules.start",
                     "does not go with contact.engine = \"hard\": granules that rest lie in each other",
                     {"allowed: loose, lattice, given"});
    if (file.has("time.granule_step"))
        file.mistake("time.granule_step",
                     "has no meaning for contact.engine = \"hard\", which goes from collision to "
                     "collision",
                     {"leave it out"});
    bool known = true;
    for (auto const& body : data.bodies) {
        try {
            dem::HardWalls({body});
        } catch (base::NumericsError const& error) {
            known = false;
            file.mistake(file.has("internal") ? "internal" : "apparatus.solid",
                         fmt::format("\"{}\": {}", body.name, error.what()), {soft_hint});
        }
    }
    for (std::size_t k = 0; k < data.walls.size(); ++k) {
        try {
            dem::HardWalls({data.walls[k]});
        } catch (base::NumericsError const& error) {
            known = false;
            file.mistake(fmt::format("wall[{}]", k), error.what(), {soft_hint});
        }
    }
    if (known && !file.any_mistake()) check_start(file, data);
}
}
