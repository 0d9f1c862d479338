// The vectorised loop that moves granules on. Included by one source per instruction set, see lanes.hpp.
//
// Without fused operations, which not all processors have: the motion has the same bits whatever the instruction set.
#pragma once

#include "granum/dem/kernel/kernel.hpp"
#include "granum/dem/kernel/lanes.hpp"

namespace granum::dem::GRANUM_KERNEL
{
namespace
{
using namespace kernel;

// Four numbers at a time: the fourth of a velocity is the inverse mass, of a spin the rounder, of a position the
// radius, of a drag the share and the push, and what is added to them is zero. Two at a time in two rounds.
using Four = hn::CappedTag<double, 4>;
using FourLanes = hn::Vec<Four>;

// What a drag does to a row, as far as it is in the registers.
struct Pulled
{
    double* given;
    FourLanes pull, share, push, sum;

    HWY_INLINE Pulled(Drag& drag, std::size_t c) : given(drag.given + c)
    {
        Four const d;
        pull = hn::Load(d, drag.pull + c), sum = hn::Load(d, given);
        share = hn::Set(d, drag.share), push = hn::Set(d, drag.push);
    }
    template <class Numbers>
    HWY_INLINE FourLanes kick(FourLanes const& motion, FourLanes const& force, Numbers const& three)
    {
        auto const pushed = hn::Add(motion, hn::Mul(push, force));
        auto const gain = hn::IfThenElseZero(three, hn::Sub(pull, hn::Mul(share, pushed)));
        sum = hn::Add(sum, gain);
        return hn::Add(pushed, gain);
    }
    HWY_INLINE void keep() const { hn::Store(sum, Four(), given); }
};

template <int Kicks, bool Drifts, bool Gas, bool Turns>
HWY_FLATTEN void move_rows(Motion const& in, MotionSeen& seen)
{
    Four const d;
    std::size_t const lanes = hn::Lanes(d);
    alignas(32) double const weight[4] = {in.half * in.gravity[0], in.half * in.gravity[1], in.half * in.gravity[2], 0};
    alignas(32) double const drift[4] = {in.drift, in.drift, in.drift, 0};
    auto const none = hn::Zero(d);
    for (std::size_t c = 0; c < 4; c += lanes) {
        auto const fall = hn::Load(d, weight + c), along = hn::Load(d, drift + c);
        auto const three = hn::FirstN(d, 3 - c);
        auto hastiest = none, odd = none;
        for (std::size_t k = 0; k < in.count; ++k) {
            auto const row = in.rows[k];
            Body& body = in.bodies[row];
            auto const force = hn::Load(d, body.force + c), torque = hn::Load(d, body.torque + c);
            auto velocity = hn::Load(d, body.velocity + c), spin = hn::Load(d, body.spin + c);
            if constexpr (Gas) {
                Pulled gas(in.gas[row], c);
                for (int kick = 0; kick < Kicks; ++kick) velocity = gas.kick(velocity, force, three);
                gas.keep();
            } else {
                auto const gain = hn::Mul(hn::Set(d, in.half * body.inverse_mass), force);
                for (int kick = 0; kick < Kicks; ++kick) velocity = hn::Add(hn::Add(velocity, gain), fall);
            }
            if constexpr (Turns) {
                Pulled gas(in.turn[row], c);
                for (int kick = 0; kick < Kicks; ++kick) spin = gas.kick(spin, torque, three);
                gas.keep();
            } else {
                auto const gain =
                    hn::Mul(hn::Set(d, in.half * 2.5 * body.inverse_mass / (body.radius * body.radius)), torque);
                for (int kick = 0; kick < Kicks; ++kick) spin = hn::Add(spin, gain);
            }
            hn::Store(spin, d, body.spin + c);
            if constexpr (Drifts) {
                hn::Store(hn::Add(hn::Load(d, body.position + c), hn::Mul(along, velocity)), d, body.position + c);
                auto const square = hn::Mul(velocity, velocity);
                hastiest = hn::Max(hastiest, hn::Mul(square, hn::Set(d, body.per_room2)));
                odd = hn::MulAdd(hn::Add(square, spin), none, odd);  // zero as long as all is finite
            }
            hn::Store(velocity, d, body.velocity + c);
            if (in.clear) hn::Store(none, d, body.force + c), hn::Store(none, d, body.torque + c);
        }
        if constexpr (Drifts) {
            alignas(32) double each[4], miss[4];
            hn::Store(hastiest, d, each), hn::Store(odd, d, miss);
            for (std::size_t lane = 0; lane < lanes; ++lane) {
                if (c + lane < 3) seen.hastiest2 += each[lane];
                seen.finite = seen.finite && miss[lane] == 0;
            }
        }
    }
}

template <bool Gas, bool Turns>
void move_in(Motion const& in, MotionSeen& seen)
{
    if (in.kicks == 2)
        move_rows<2, true, Gas, Turns>(in, seen);
    else if (in.drift != 0)
        move_rows<1, true, Gas, Turns>(in, seen);
    else
        move_rows<1, false, Gas, Turns>(in, seen);
}

inline void move(Motion const& in, MotionSeen& seen)
{
    if (in.gas == nullptr)
        move_in<false, false>(in, seen);
    else if (in.turn == nullptr)
        move_in<true, false>(in, seen);
    else
        move_in<true, true>(in, seen);
}
}
}
