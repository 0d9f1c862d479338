#include "granum/sim/wall_time.hpp"

#include "granum/base/bandwidth.hpp"

#include <algorithm>
#include <barrier>
#include <cmath>
#include <ctime>
#include <thread>
#include <vector>

namespace granum::sim
{
namespace
{
// Contact-like evaluations per second, timed for 20 ms of processor time of this thread: roots and divisions that wait
// for each other, as a contact's do.
double kernel_rate()
{
    auto const now = [] {
        timespec t{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
        return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
    };
    double const start = now();
    double seconds = 0, x = 1.1;
    long done = 0;
    while (seconds < 0.02) {
        for (int i = 0; i < 1000; ++i) {
            double const r = std::sqrt(x * x + 0.3);
            x += (1.2 - r) * std::sqrt(r) / r;
        }
        done += 1000;
        seconds = now() - start;
    }
    return std::isfinite(x) ? static_cast<double>(done) / seconds : 1;  // the use of x keeps the loop
}

// As measured on this program's own runs: doc/howto/size-a-run.md says which. On other processors their ratio to the
// kernel is another.
constexpr double evaluations_per_granule_step = 4.5;  //!< of granules at rest on each other
constexpr double evaluations_per_flying_step = 2.2;   //!< of granules that gas keeps apart
constexpr double bytes_per_flying_step = 900;         //!< of those whose rows and lists do not stay in the last cache
constexpr double bytes_in_cache = 1000;               //!< of a granule's rows and lists
constexpr double evaluations_per_cell_step = 43;      //!< of an open cell: momentum, pressure, vapour, heat
constexpr double bytes_per_cell_step = 18e3;
constexpr double evaluations_per_exchange = 39;    //!< of a parcel in a gas step
constexpr double evaluations_per_droplet = 13500;  //!< a droplet parcel's flight and the drying of its deposit
constexpr double beside = 1.03;                    //!< all else: pictures, checkpoints, set-up
constexpr double lost_per_doubling = 0.25;         //!< of ranks, to uneven work and what they share
constexpr double waiting_per_gas_step = 1.1e5;     //!< evaluations, of ranks for each other's messages
constexpr double last_cache = 32e6;                //!< bytes (assumed: systems tell it wrongly)
}

MachineSpeed machine_speed(int cores)
{
    auto const count = static_cast<std::size_t>(std::clamp(cores, 1, 8));
    std::vector<MachineSpeed> each(count);
    std::barrier together(static_cast<std::ptrdiff_t>(count));
    std::vector<std::thread> threads;
    for (auto& speed : each)
        threads.emplace_back([&speed, &together] {
            together.arrive_and_wait();
            speed.evaluations = kernel_rate();
            together.arrive_and_wait();
            speed.bytes = base::triad_rate();
        });
    for (auto& thread : threads) thread.join();
    MachineSpeed slowest = each.front();
    for (auto const& speed : each)
        slowest = {std::min(slowest.evaluations, speed.evaluations), std::min(slowest.bytes, speed.bytes)};
    return slowest;
}

double wall_time(Case const& data, Forecast const& forecast, int ranks, MachineSpeed const& speed)
{
    double const time = data.time.duration, parcels = static_cast<double>(forecast.parcels);
    double const gas_steps = forecast.gas_step > 0 ? time / forecast.gas_step : 0;
    auto const seconds = [&speed](double evaluations, double bytes) {
        return evaluations / speed.evaluations + bytes / speed.bytes;
    };
    double work = 0;  // s of one core
    if (forecast.granule_step > 0) {
        bool const flies = forecast.plate_velocity > forecast.minimum_fluidisation;
        double const outside = parcels > 0 ? std::max(0.0, 1 - last_cache / (parcels * bytes_in_cache)) : 0;
        work += time / forecast.granule_step * parcels *
                (flies ? seconds(evaluations_per_flying_step, outside * bytes_per_flying_step)
                       : seconds(evaluations_per_granule_step, 0));
    }
    if (gas_steps > 0) {
        auto const extent = data.chamber.upper() - data.chamber.lower();
        double const cells =
            static_cast<double>(forecast.cells) * data.chamber.volume() / (extent.x * extent.y * extent.z);
        work += gas_steps * (cells * seconds(evaluations_per_cell_step, bytes_per_cell_step) +
                             parcels * seconds(evaluations_per_exchange, 0));
    }
    if (!data.spray.nozzles.empty()) work += time * data.spray.parcels_per_second * seconds(evaluations_per_droplet, 0);
    double const share = (1 + lost_per_doubling * std::log2(ranks)) / ranks;
    return beside * share * work + (ranks > 1 ? gas_steps * seconds(waiting_per_gas_step, 0) : 0);
}
}
