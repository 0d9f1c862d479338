// The sections of a case, each read into its struct; the pieces that case_reader puts together.
#pragma once

#include "granum/io/case_file.hpp"
#include "granum/sim/case.hpp"
#include "granum/sim/case_reader.hpp"

namespace granum::sim
{
void read_apparatus(io::CaseFile& file, Case& data, Purpose purpose);
void read_granules(io::CaseFile& file, Case& data, Purpose purpose);
void read_contact(io::CaseFile& file, Case& data);
void read_gas(io::CaseFile& file, Case& data, Purpose purpose);
void read_cells(io::CaseFile& file, Case& data);  //!< after the apparatus and the granules
void read_spray(io::CaseFile& file, Case& data, Purpose purpose);
void read_process(io::CaseFile& file, Case& data, Purpose purpose);  //!< [drying] [product] [start] [time] [output]

//! What no single value shows: the mistakes and warnings that follow from values together.
void cross_check(io::CaseFile& file, Case const& data, Purpose purpose, std::vector<std::string>& warnings);

//! Lets the sections take missing values from the material named by `key`; a wrong name is a mistake there. Returns the
//! name, empty where none is given.
std::string take_material(io::CaseFile& file, std::string const& key, std::vector<std::string> const& sections);
}
