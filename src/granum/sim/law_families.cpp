#include "granum/sim/law_families.hpp"

#include "granum/law/atomising/droplets.hpp"
#include "granum/law/capture/all.hpp"
#include "granum/law/conduction/all.hpp"
#include "granum/law/contact/all.hpp"
#include "granum/law/deposit/all.hpp"
#include "granum/law/deposit/crystallisation.hpp"
#include "granum/law/deposit/solidification.hpp"
#include "granum/law/deposit/stages.hpp"
#include "granum/law/dispersion/all.hpp"
#include "granum/law/drag/all.hpp"
#include "granum/law/film/all.hpp"
#include "granum/law/force/all.hpp"
#include "granum/law/force/basset.hpp"
#include "granum/law/heat/all.hpp"
#include "granum/law/layer/abrasion.hpp"
#include "granum/law/turbulence/all.hpp"
#include "granum/law/vapour/sorption.hpp"
#include "granum/law/viscosity/all.hpp"
#include "granum/product/all.hpp"

#include <stdexcept>

namespace granum::sim
{
namespace
{
template <class List>
LawFamily family(std::string name, std::string key, std::string title)
{
    return {std::move(name), std::move(key), std::move(title), {List::cards.begin(), List::cards.end()}};
}
}

std::vector<std::string> LawFamily::names() const
{
    std::vector<std::string> out;
    for (auto const& card : cards) out.emplace_back(card.name);
    return out;
}

std::vector<LawFamily> const& law_families()
{
    static std::vector<LawFamily> const all{
        family<law::drag::All>("drag", "gas.drag", "force of the gas on the granules"),
        family<law::force::VirtualMassLaws>("virtual-mass", "gas.virtual_mass",
                                            "gas that a granule moves as it speeds up"),
        {"history", "gas.history", "force of the past of the slip", {law::force::BassetWindow::card}},
        family<law::force::ShearLiftLaws>("lift-shear", "gas.shear_lift", "lift of the shear of the gas"),
        family<law::force::SpinLiftLaws>("lift-spin", "gas.spin_lift", "lift of the spin of the granules"),
        family<law::force::TorqueLaws>("torque", "gas.torque", "torque of the gas on the granules"),
        family<law::turbulence::All>("turbulence", "gas.turbulence", "turbulence of the gas"),
        family<law::viscosity::All>("viscosity", "gas.viscosity_law", "viscosity from the rate of shear"),
        family<law::dispersion::All>("dispersion", "gas.dispersion", "dispersion by the turbulence of the gas"),
        family<law::heat::All>("heat-transfer", "gas.heat_transfer", "heat and vapour between granules and gas"),
        family<law::contact::NormalLaws>("contact-normal", "contact.normal", "contact force along the line of centres"),
        family<law::contact::TangentialLaws>("contact-tangential", "contact.tangential", "contact force across it"),
        family<law::contact::RollingLaws>("contact-rolling", "contact.rolling", "resistance to rolling"),
        family<law::conduction::All>("contact-conduction", "contact.conduction", "heat between granules that touch"),
        family<law::film::All>("film", "contact.film", "heat through the gas between granules that nearly touch"),
        family<law::atomising::Droplets>("atomisation", "spray.atomisation",
                                         "Sauter diameter of the spray of a nozzle"),
        family<law::capture::All>("capture", "spray.capture", "capture of droplets by granules"),
        family<law::deposit::All>("deposit-drying", "drying.deposit", "drying of the deposit of a droplet"),
        family<law::deposit::Stages>("deposit-stages", "drying.stages", "what slows a deposit as it dries"),
        family<law::deposit::Solidification>("solidification", "drying.solidification",
                                             "heat that leaves the deposit of a melt"),
        family<law::deposit::Crystallisation>("crystallisation", "drying.crystallisation",
                                              "crystals in the deposit of a solution"),
        family<law::vapour::Sorption>("sorption", "drying.sorption", "water that cores absorb from the air"),
        family<law::layer::Abrasion>("abrasion", "drying.abrasion", "what collisions rub off layers"),
        family<product::All>("porosity", "product.porosity_model",
                             "porosity of the layer from the history of its deposits"),
    };
    return all;
}

std::vector<std::string> laws_for(std::string const& key)
{
    for (auto const& family : law_families())
        if (!key.empty() && family.key == key) return family.names();
    throw std::out_of_range("no family of laws is chosen by " + key);
}
}
