// Reads of [gas] what concerns turbulence, and the law of the viscosity.
#include "granum/law/turbulence/all.hpp"
#include "granum/law/turbulence/wall.hpp"
#include "granum/sim/case_sections.hpp"
#include "granum/sim/law_families.hpp"

namespace granum::sim
{
using io::Dimension;

namespace
{
void read_constants(io::CaseFile& file, TurbulenceCase& turbulence)
{
    if (!file.has("gas.turbulence_constants")) return;
    auto const read = [&](char const* name, double& constant) {
        auto const key = std::string("gas.turbulence_constants.") + name;
        if (file.has(key))
            turbulence.constants[name] =
                file.quantity(key, Dimension::one, constant, "of the model of turbulence", io::positive);
    };
    auto model = law::turbulence::All::make(turbulence.model);
    if (!model) return;
    std::visit([&](auto& law) { law.each_constant(read); }, *model);
    law::turbulence::WallLaw wall;
    if (!law::turbulence::is_laminar(*model)) wall.each_constant(read);
}
}

void need_eddies(io::CaseFile& file, std::string const& key, GasCase const& gas)
{
    auto const model = law::turbulence::All::make(gas.turbulence.model);
    if (gas.present && model && !law::turbulence::transports(*model))
        file.mistake(key, "needs a model of turbulence that transports k",
                     {"gas.turbulence = \"k-epsilon\" or \"k-omega-sst\""});
}

void read_turbulence(io::CaseFile& file, GasCase& gas)
{
    TurbulenceCase& turbulence = gas.turbulence;
    turbulence.model =
        file.name("gas.turbulence", turbulence.model, "model", laws_for("gas.turbulence"), "a model of turbulence");
    read_constants(file, turbulence);
    turbulence.intensity =
        file.quantity("gas.turbulence_intensity", Dimension::one, turbulence.intensity,
                      "root mean square of a fluctuation over the velocity of what enters", io::not_negative);
    turbulence.length = file.optional_quantity("gas.turbulence_length", Dimension::length,
                                               "of eddies, at the start and of what enters", io::positive);
    turbulence.velocity = file.optional_quantity("gas.turbulence_velocity", Dimension::velocity,
                                                 "root mean square of a fluctuation at the start", io::positive);
    turbulence.prandtl = file.quantity("gas.turbulent_prandtl", Dimension::one, turbulence.prandtl,
                                       "eddy viscosity over eddy conductivity of heat", io::positive);
    turbulence.schmidt = file.quantity("gas.turbulent_schmidt", Dimension::one, turbulence.schmidt,
                                       "eddy viscosity over eddy diffusivity", io::positive);
    turbulence.dense = file.quantity("gas.turbulence_dense", Dimension::one, turbulence.dense,
                                     "voidage below which granules leave no eddies", io::zero_to_one);
    turbulence.free = file.quantity("gas.turbulence_free", Dimension::one, turbulence.free,
                                    "voidage above which granules leave them alone", io::zero_to_one);
    if (turbulence.free <= turbulence.dense) file.mistake("gas.turbulence_free", "is not above turbulence_dense");
    turbulence.granules =
        file.boolean("gas.granule_turbulence", false, "granules damp turbulence, and make some in their wakes");
    turbulence.wake = file.quantity("gas.granule_wake", Dimension::one, turbulence.wake,
                                    "share of the work of drag that becomes turbulence", io::zero_to_one);
    turbulence.memory = file.quantity("gas.eddy_memory", Dimension::one, turbulence.memory,
                                      "Lagrangian time over k/epsilon", io::positive);
    turbulence.rate = file.quantity("gas.granule_dissipation", Dimension::one, turbulence.rate,
                                    "C_3, of what granules change in the dissipation", io::not_negative);
    if (turbulence.granules) need_eddies(file, "gas.granule_turbulence", gas);
    gas.dispersion =
        file.name("gas.dispersion", gas.dispersion, "law", laws_for("gas.dispersion"), "a law of turbulent dispersion");
    if (gas.dispersion != "none") need_eddies(file, "gas.dispersion", gas);

    ViscosityCase& thinning = gas.thinning;
    thinning.law =
        file.name("gas.viscosity_law", thinning.law, "law", laws_for("gas.viscosity_law"), "a law of viscosity");
    thinning.infinite = file.quantity("gas.viscosity_infinite", Dimension::viscosity, thinning.infinite,
                                      "at infinite shear", io::not_negative);
    thinning.time =
        file.quantity("gas.viscosity_time", Dimension::time, thinning.time, "of relaxation", io::not_negative);
    thinning.exponent = file.quantity("gas.viscosity_exponent", Dimension::one, thinning.exponent,
                                      "of the power law between the plateaus", {.low = 0, .high = 3});
}
}
