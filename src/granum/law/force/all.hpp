// The forces of the gas beside drag, one list per force: a new law adds its name here.
#pragma once

#include "granum/law/force/none.hpp"
#include "granum/law/force/shear_lift_saffman_mei.hpp"
#include "granum/law/force/spin_lift_loth_dorgan.hpp"
#include "granum/law/force/spin_lift_rubinow_keller.hpp"
#include "granum/law/force/torque_dennis.hpp"
#include "granum/law/force/virtual_mass_constant.hpp"
#include "granum/law/force/virtual_mass_none.hpp"
#include "granum/law/force/virtual_mass_van_wijngaarden.hpp"
#include "granum/law/force/virtual_mass_zuber.hpp"

namespace granum::law::force
{
using VirtualMassLaws = base::TypeList<NoVirtualMass, ConstantVirtualMass, VanWijngaarden, Zuber>;
using ShearLiftLaws = base::TypeList<None, SaffmanMei>;
using SpinLiftLaws = base::TypeList<None, RubinowKeller, LothDorgan>;
using TorqueLaws = base::TypeList<None, Dennis>;

//! C of the virtual mass C rho V, by the law held by `law`.
inline double virtual_mass(VirtualMassLaws::Any const& law, Crowd const& crowd)
{
    return std::visit([&](auto const& chosen) { return chosen(crowd); }, law);
}

//! Lift (N) or torque (N m) on a granule, by the law of one of the other lists held by `law`.
template <class Any>
math::Vec3 on_granule(Any const& law, Motion const& motion)
{
    return std::visit([&](auto const& chosen) { return chosen(motion); }, law);
}
}
