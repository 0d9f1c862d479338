// The operating programme of a case: what is heated, sprayed, dried and cooled when.
#pragma once

#include "granum/sim/case.hpp"

#include <span>

namespace granum::sim
{
//! The value of one quantity at `time` s: phases that name it set it for good, at once or, where they ramp, in a
//! straight line from what it was over their length. `of` gives a phase's value, or nothing.
template <class Of>
double value_at(std::span<PhaseCase const> phases, double time, double value, Of const& of)
{
    for (auto const& phase : phases) {
        if (time <= phase.start) break;
        std::optional<double> const target = of(phase);
        if (!target) continue;
        double const share = phase.ramp && time < phase.end ? (time - phase.start) / (phase.end - phase.start) : 1;
        value += share * (*target - value);
    }
    return value;
}

//! Air of the inlets and rate of the spray that a case starts from.
struct Nominal
{
    std::vector<InletCase> inlets;
    double spray_rate = 0;

    explicit Nominal(Case const& data) : inlets(data.gas.inlets), spray_rate(data.spray.rate) {}
};

//! Sets inlets and spray of `data` to what its programme has at `time`; true where anything changed.
bool follow(Case& data, Nominal const& nominal, double time);
}
