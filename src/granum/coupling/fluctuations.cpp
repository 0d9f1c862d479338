// What granules see of the gas's turbulence: a fluctuation for each, held for one interval.
#include "granum/coupling/exchange.hpp"

#include "granum/base/random.hpp"

namespace granum::coupling
{
void Exchange::find_fluctuations(particle::Store& granules, gas::State const& state, double dt, std::uint32_t step,
                                 Seen& seen)
{
    auto eddies = solver_.eddies(state);
    auto& slope = eddies.gradient;
    Field* fields[] = {&eddies.energy, &eddies.dissipation, &slope[0], &slope[1], &slope[2]};
    mapping_.prepare(fields);
    if (more_.empty()) more_ = mapping_.make_bundle();
    mapping_.bundle({&eddies.energy, &eddies.dissipation, &slope[0], &slope[1], &slope[2], nullptr, nullptr, nullptr},
                    more_);
    seen.fluctuation.resize(granules.owned);
    auto const stencils = mapping_.stencils();
    for (std::size_t row = 0; row < granules.owned; ++row) {
        auto const [k, epsilon, x, y, z, a, b, c] = mapping_.gather(stencils[row], more_);
        law::dispersion::Turbulence const gas{.energy = k,
                                              .dissipation = epsilon,
                                              .gradient = {x, y, z},
                                              .slip = math::norm(seen.velocity[row] - granules.velocity[row])};
        base::Random random(laws_.seed, base::Purpose::dispersion, granules.id[row], step);
        Vec3 normals;
        for (std::size_t d = 0; d < 3; ++d) normals[d] = random.normal();
        law::dispersion::Eddy eddy{granules.fluctuation[row], granules.eddy_left[row]};
        seen.fluctuation[row] = law::dispersion::fluctuation(laws_.dispersion, eddy, gas, dt, normals);
        granules.fluctuation[row] = eddy.fluctuation;
        granules.eddy_left[row] = eddy.left;
        seen.velocity[row] += seen.fluctuation[row];
    }
}
}
