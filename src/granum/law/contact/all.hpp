// The laws of contact, one list per slot: a new law adds its name here.
#pragma once

#include "granum/law/contact/hard_sphere.hpp"
#include "granum/law/contact/normal_hertz_tsuji.hpp"
#include "granum/law/contact/normal_linear.hpp"
#include "granum/law/contact/normal_viscoelastic.hpp"
#include "granum/law/contact/rolling.hpp"
#include "granum/law/contact/tangential_incremental.hpp"
#include "granum/law/contact/tangential_mindlin.hpp"

namespace granum::law::contact
{
using NormalLaws = base::TypeList<HertzTsuji, HertzViscoelastic, Linear>;
using TangentialLaws = base::TypeList<Mindlin, MindlinIncremental, MindlinRescaled>;
using RollingLaws = base::TypeList<Epsd, EpsdDashpot, NoRolling>;
using HardLaws = base::TypeList<Hoomans>;
}
