// Granule steps per second of the packed bed of 20,000 (bench/peers), alone and in a held gas, for several lengths of a
// coupling interval: what gas costs the granules, and what it costs to stop between intervals. All of them in turns, by
// the clock of the processor. Arguments: rounds (9), steps of each measurement (600), the state.
#include "peers/box.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>

using namespace granum;

namespace
{
double processor_seconds()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

//! A slow stream upward, whose drag carries a twentieth of the weight.
void blow(particle::Store& granules, bool on)
{
    for (std::size_t row = 0; row < granules.owned; ++row) {
        granules.drag_rate[row] = on ? 10 : 0;
        granules.gas_velocity[row] = {0, 0, 0.05};
        granules.gas_force[row] = {};
    }
}

struct Case
{
    char const* name;
    bool gas;
    int interval;  //!< steps of a call
    std::vector<double> rates{};
};
}

int main(int argc, char** argv)
{
    MPI_Init(&argc, &argv);
    {
        long const rounds = argc > 1 ? std::atol(argv[1]) : 9;
        int const steps = argc > 2 ? std::atoi(argv[2]) : 600;
        auto const path =
            argc > 3 ? std::filesystem::path(argv[3]) : std::filesystem::path(argv[0]).parent_path() / "packed.csv";
        constexpr double dt = 1e-5;
        par::Communicator const comm(MPI_COMM_SELF);
        peers::Box box(peers::read_state(path), 1, 1, {}, {}, comm);
        auto& granules = box.granules;
        granules.keep({.parcel = false, .gas = true, .process = false});
        box.engine->advance(granules, dt, 1000);

        std::vector<Case> cases;
        for (int const interval : {1000, 100, 50, 25})
            for (bool const gas : {false, true}) cases.push_back({gas ? "gas" : "alone", gas, interval});
        for (long round = 0; round < rounds; ++round)
            for (auto& one : cases) {
                blow(granules, one.gas);
                box.engine->advance(granules, dt, 12);
                double const start = processor_seconds();
                for (int done = 0; done < steps; done += one.interval)
                    box.engine->advance(granules, dt, std::min(one.interval, steps - done));
                one.rates.push_back(static_cast<double>(steps * box.total) / (processor_seconds() - start));
            }
        fmt::print("{} granules, kernel {}, coordination {:.2f}\n", box.total, box.engine->kernel(),
                   box.coordination(comm));
        double const first = [&] {
            auto rates = cases[0].rates;
            std::nth_element(rates.begin(), rates.begin() + rounds / 2, rates.end());
            return rates[static_cast<std::size_t>(rounds / 2)];
        }();
        for (auto& [name, gas, interval, rates] : cases) {
            std::sort(rates.begin(), rates.end());
            double const median = rates[static_cast<std::size_t>(rounds / 2)];
            fmt::print("{:5} {:5} steps a call: {:.3g} granule steps per second (from {:.3g} to {:.3g}), time {:.3f}\n",
                       name, interval, median, rates.front(), rates.back(), first / median);
        }
    }
    MPI_Finalize();
}
