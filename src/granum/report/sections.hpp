// The sections of the page, each from what the run left behind; a section without its data says so.
#pragma once

#include "granum/report/run_folder.hpp"

#include <string>

namespace granum::report
{
std::string verdict_section(RunFolder const& run);   //!< title, how the run ended, what the product will be
std::string checks_section(RunFolder const& run);    //!< ledgers and agreement with the balance, in words
std::string pictures_section(RunFolder const& run);  //!< also writes pictures/*.png into the run folder
std::string curves_section(RunFolder const& run);
std::string events_section(RunFolder const& run);
std::string porosity_section(RunFolder const& run);
std::string packing_section(RunFolder const& run);  //!< of granules alone: contacts, energy, what came and went
std::string product_section(RunFolder const& run);
std::string probes_section(RunFolder const& run);  //!< "" without probes
std::string spray_section(RunFolder const& run);
std::string performance_section(RunFolder const& run);
std::string warnings_section(RunFolder const& run);
std::string case_section(RunFolder const& run);

//! A figure with its sentence; the sentence alone, with "no data yet", where `drawing` is empty.
std::string figure(std::string const& drawing, std::string const& caption);
//! A table row of a name and a value, both escaped here.
std::string row(std::string const& name, std::string const& value);
//! <section id=...> with its heading.
std::string section(std::string const& id, std::string const& heading, std::string const& body);
}
