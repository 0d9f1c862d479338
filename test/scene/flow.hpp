// Flow of gas alone, stated as a case: text for boxes, runs to the steady state, values along lines.
#pragma once

#include "scene/case_text.hpp"

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace granum::scene
{
//! A box of gas without gravity; `rest` are lines of [gas], of [[gas.wall]], [[inlet]] and so on.
inline std::string gas_in_box(math::Vec3 const& size, std::array<int, 3> cells, std::string const& periodic,
                              std::string const& rest)
{
    return "gravity = [\"0 m/s2\", \"0 m/s2\", \"0 m/s2\"]\n[apparatus]\nshape = \"box\"\nsize = " +
           vector_text(size, "m") + "\nperiodic = [" + periodic +
           "]\n[start]\nquasi_steady = false\n[time]\nduration = \"1 s\"\n" + "[gas]\n" +
           fmt::format("cells = [{}, {}, {}]\n", cells[0], cells[1], cells[2]) + rest;
}

//! Steps until no velocity changes by more than `rest` (m/s) within `interval` seconds. Returns the time, s.
inline double run_to_rest(sim::Simulation& simulation, double dt, double interval, double rest, double longest)
{
    auto before = simulation.gas().velocity;
    while (simulation.time() < longest) {
        double const goal = simulation.time() + interval;
        while (simulation.time() < goal * (1 - 1e-12)) simulation.step(std::min(dt, goal - simulation.time()));
        double change = 0;
        auto const& now = simulation.gas().velocity;
        for (std::size_t d = 0; d < 3; ++d)
            for (std::size_t c = 0; c < now[d].size(); ++c)
                change = std::max(change, std::abs(now[d][c] - before[d][c]));
        if (change < rest) break;
        before = now;
    }
    return simulation.time();
}

//! Values known at places that rise; linear between them, and straight on beyond the ends.
struct Line
{
    std::vector<double> place, value;

    double at(double x) const
    {
        std::size_t k = 1;
        while (k + 1 < place.size() && place[k] < x) ++k;
        double const part = (x - place[k - 1]) / (place[k] - place[k - 1]);
        return value[k - 1] + part * (value[k] - value[k - 1]);
    }
    //! Largest value and its place, by a parabola through the largest point and its neighbours.
    std::pair<double, double> largest() const
    {
        std::size_t k = 1;
        for (std::size_t i = 1; i + 1 < value.size(); ++i)
            if (value[i] > value[k]) k = i;
        double const h = place[k + 1] - place[k];
        double const slope = 0.5 * (value[k + 1] - value[k - 1]), bend = value[k + 1] + value[k - 1] - 2 * value[k];
        double const off = bend < 0 ? -slope / bend : 0;
        return {value[k] + 0.5 * slope * off, place[k] + off * h};
    }
};
}
