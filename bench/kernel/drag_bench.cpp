// Time of one drag law for one granule, over the states of a bed: what a law costs inside the exchange.
#include "granum/law/drag/all.hpp"

#include <benchmark/benchmark.h>

#include <array>
#include <string>
#include <variant>

namespace
{
using granum::law::drag::All;
using granum::law::drag::Flow;

std::array<Flow, 1024> bed_states()
{
    std::array<Flow, 1024> states{};
    for (std::size_t i = 0; i < states.size(); ++i) {
        double const share = (static_cast<double>(i) + 0.5) / static_cast<double>(states.size());
        states[i] = {.solid_fraction = 0.05 + 0.55 * share, .reynolds = 1 + 200 * (1 - share)};
    }
    return states;
}

template <class Law>
void time_law(benchmark::State& state)
{
    auto const states = bed_states();
    Law const law;
    for (auto _ : state) {
        double sum = 0;
        for (auto const& flow : states) sum += law(flow);
        benchmark::DoNotOptimize(sum);
    }
    state.SetItemsProcessed(state.iterations() * static_cast<long>(states.size()));
}

template <class... Laws>
void register_laws(granum::base::TypeList<Laws...>)
{
    (benchmark::RegisterBenchmark(std::string(Laws::card.name).c_str(), time_law<Laws>), ...);
}
}

int main(int argc, char** argv)
{
    register_laws(All{});
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
