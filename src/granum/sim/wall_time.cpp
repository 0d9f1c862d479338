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
// Contact-like evaluations per second, timed for that many seconds of processor time of this thread: roots and
// divisions that wait for each other, as a contact's do.
double kernel_rate(double length)
{
    auto const now = [] {
        timespec t{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
        return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
    };
    double const start = now();
    double seconds = 0, x = 1.1;
    long done = 0;
    while (seconds < length) {
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
constexpr double evaluations_per_flying_step = 1.85;  //!< of granules that gas keeps apart
constexpr double evaluations_per_cell_step = 46;      //!< of an open cell: momentum, pressure, vapour, heat
constexpr double evaluations_per_exchange = 33;       //!< of a parcel in a gas step
constexpr double evaluations_per_droplet = 15000;     //!< a droplet parcel's flight and the drying of its deposit
constexpr double last_cache = 32e6;                   //!< bytes (assumed: systems tell it wrongly)
constexpr double bytes_of_a_granule = 1000;           //!< its rows and lists (assumed)
constexpr double bytes_per_flying_step = 1300;        //!< to and from memory, where that does not stay in the cache
constexpr double bytes_per_cell_step = 9.1e3;
constexpr double beside = 1.08;                //!< all else: pictures, checkpoints, audits, set-up
constexpr double lost_per_doubling = 0.20;     //!< of ranks, to uneven work and what they share
constexpr double waiting_per_gas_step = 82e3;  //!< evaluations, of ranks for each other's messages

//! Which part of `count` things does not stay in the last cache.
double outside(double count, double bytes)
{
    return count > 0 ? std::max(0.0, 1 - last_cache / (count * bytes)) : 0;
}
}

MachineSpeed machine_speed(int cores)
{
    auto const count = static_cast<std::size_t>(std::clamp(cores, 1, 8));
    std::vector<MachineSpeed> each(count);
    std::barrier together(static_cast<std::ptrdiff_t>(count));
    std::vector<base::Triad> triads(count);
    std::vector<std::thread> threads;
    for (std::size_t k = 0; k < count; ++k)
        threads.emplace_back([&speed = each[k], &triad = triads[k], &together] {
            together.arrive_and_wait();
            kernel_rate(0.02);  // an idle core takes its time to get up to speed
            speed.evaluations = kernel_rate(0.05);
            together.arrive_and_wait();
            speed.bytes = 0;  // neighbours on the machine make it half as fast for some moments: a mean
            for (int i = 0; i < 4; ++i) speed.bytes += triad.rate() / 4;
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
        double const bytes = bytes_per_flying_step * outside(parcels, bytes_of_a_granule);
        work += time / forecast.granule_step * parcels *
                (flies ? seconds(evaluations_per_flying_step, bytes) : seconds(evaluations_per_granule_step, 0));
    }
    if (gas_steps > 0) {
        auto const extent = data.chamber.upper() - data.chamber.lower();
        double const cells =
            static_cast<double>(forecast.cells) * data.chamber.volume() / (extent.x * extent.y * extent.z);
        double const bytes = bytes_per_cell_step * outside(cells, bytes_of_a_cell);
        work += gas_steps *
                (cells * seconds(evaluations_per_cell_step, bytes) + parcels * seconds(evaluations_per_exchange, 0));
    }
    if (!data.spray.nozzles.empty()) work += time * data.spray.parcels_per_second * seconds(evaluations_per_droplet, 0);
    double const share = (1 + lost_per_doubling * std::log2(ranks)) / ranks;
    return beside * share * work + (ranks > 1 ? gas_steps * seconds(waiting_per_gas_step, 0) : 0);
}
}
