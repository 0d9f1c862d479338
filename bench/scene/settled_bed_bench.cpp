// Granule steps per second in a settled bed of 11,000 spheres: the cost of contacts at rest, on one core. The clock is
// that of the processor, so that a busy machine does not hide the cost. Argument: steps to settle (15000).
#include "scene/granules.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>

using namespace granum;

namespace
{
double processor_seconds()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}
}

int main(int argc, char** argv)
{
    MPI_Init(&argc, &argv);
    {
        constexpr double radius = 2.4e-3, density = 1445, dt = 2e-5;
        scene::Scene scene({1e7, 0.25, density},
                           {.restitution = 0.8, .sliding_friction = 0.3, .rolling_friction = 0.01});
        scene.settings.gravity = {0, 0, -9.81};
        geometry::Chamber chamber;
        chamber.size = {0.18, 0.18, 0.4};
        scene.enclose(chamber.lower(), chamber.upper());
        for (auto const& position : particle::random_loose(chamber, radius, 11000, 1))
            scene.add(position, {}, radius, density);
        scene.prepare();
        double const start_energy = scene.potential_energy();
        scene.run(argc > 1 ? std::atol(argv[1]) : 15000, dt);
        fmt::print("settled: kinetic over released energy {:.2e}, {:.2f} contacts per granule\n",
                   scene.kinetic_energy() / (start_energy - scene.potential_energy()),
                   static_cast<double>(scene.engine->watch().contacts) / 11000);

        constexpr int repetitions = 7, steps = 400;
        std::vector<double> rates;
        for (int k = 0; k < repetitions; ++k) {
            double const start = processor_seconds();
            scene.run(steps, dt);
            rates.push_back(steps / (processor_seconds() - start));
        }
        std::sort(rates.begin(), rates.end());
        auto const contacts = static_cast<double>(scene.engine->watch().contacts);
        fmt::print("granule steps per second: {:.3g} (from {:.3g} to {:.3g}); contacts per second: {:.3g}\n",
                   11000 * rates[repetitions / 2], 11000 * rates.front(), 11000 * rates.back(),
                   contacts * rates[repetitions / 2]);
        double const start = processor_seconds();
        for (int k = 0; k < 20; ++k) scene.engine->prepare(scene.granules);
        double const rebuild = (processor_seconds() - start) / 20;
        fmt::print("one rebuild of the neighbour list: {:.2f} ms, candidates per granule {:.2f}; a step: {:.2f} ms\n",
                   1e3 * rebuild, static_cast<double>(scene.engine->candidates()) / 11000,
                   1e3 / rates[repetitions / 2]);
    }
    MPI_Finalize();
}
