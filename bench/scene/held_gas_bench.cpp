// Granule steps per second of the packed bed of 20,000 (bench/peers), alone, in a held gas, and in one that also turns
// granules and is carried by them, for several numbers of steps a call: what gas costs the granules, and what it costs
// to stop between coupling intervals. All in turns, by the clock of the processor, each beside the granules alone of
// its round. Ranks as mpirun starts. Arguments: rounds (9), steps of a measurement (600), the state.
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

enum class Around
{
    nothing,
    gas,
    turning_gas
};

//! A slow stream upward, whose drag carries a twentieth of the weight.
void blow(particle::Store& granules, Around around)
{
    bool const gas = around != Around::nothing, turning = around == Around::turning_gas;
    granules.keep({.parcel = false, .gas = gas, .process = false, .added_mass = turning, .turning = turning});
    for (std::size_t row = 0; row < granules.owned && gas; ++row) {
        granules.drag_rate[row] = 10;
        granules.gas_velocity[row] = {0, 0, 0.05};
        if (!turning) continue;
        granules.added_mass[row] = 1e-3 * granules.mass[row];
        granules.spin_rate[row] = 10;
    }
}

struct Case
{
    Around around;
    int together;                          //!< steps of a call
    std::vector<double> rates{}, times{};  //!< granule steps per second; over the time of the first case of the round
};

double median(std::vector<double> of)
{
    auto const middle = of.begin() + static_cast<std::ptrdiff_t>(of.size() / 2);
    std::nth_element(of.begin(), middle, of.end());
    return *middle;
}
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
        par::Communicator const comm;
        peers::Box box(peers::read_state(path), 1, 1, {}, {}, comm);
        box.engine->advance(box.granules, dt, 1000);

        std::vector<Case> cases;
        for (int const together : {1000, 100, 50, 25})
            for (auto const around : {Around::nothing, Around::gas, Around::turning_gas})
                cases.push_back({around, together});
        for (long round = 0; round < rounds; ++round)
            for (auto& one : cases) {
                blow(box.granules, one.around);
                box.engine->advance(box.granules, dt, 12);
                comm.barrier();
                double const start = processor_seconds();
                for (int done = 0; done < steps; done += one.together)
                    box.engine->advance(box.granules, dt, std::min(one.together, steps - done));
                comm.barrier();
                one.rates.push_back(static_cast<double>(steps * box.total) / (processor_seconds() - start));
                one.times.push_back(cases[0].rates.back() / one.rates.back());
            }
        double const coordination = box.coordination(comm);
        if (comm.root()) {
            fmt::print("{} granules, {} ranks, kernel {}, coordination {:.2f}\n", box.total, comm.size(),
                       box.engine->kernel(), coordination);
            for (auto const& [around, together, rates, times] : cases) {
                auto const [least, most] = std::minmax_element(times.begin(), times.end());
                fmt::print(
                    "{:12}{:5} steps a call: {:.3g} granule steps per second (at best {:.4g}), time {:.3f} (from "
                    "{:.3f} to {:.3f})\n",
                    around == Around::nothing ? "alone"
                    : around == Around::gas   ? "gas"
                                              : "turning gas",
                    together, median(rates), *std::max_element(rates.begin(), rates.end()), median(times), *least,
                    *most);
            }
        }
    }
    MPI_Finalize();
}
