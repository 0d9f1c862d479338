// What a run folder says of itself to who wants to go on with it: whose case it is, what differs, whether it is done.
#pragma once

#include "granum/sim/case.hpp"

#include <string>

namespace granum::sim
{
//! The values that shaped the state up to now, one "key = value" per line: all but title, duration and output.
std::string shaping_values(ResolvedCase const& resolved);
std::uint64_t case_hash(ResolvedCase const& resolved);

//! Writes `folder`/checkpoint/case.txt, which `refuse_other_case` reads. Throws base::IoError.
void remember_case(std::string const& folder, ResolvedCase const& resolved);

//! True where `folder` is one that `granum run` wrote and can go on with.
bool is_run_folder(std::string const& folder);

//! The case file that the run in `folder` was started from, or its copy there where that is gone or was changed.
std::string case_file_of(std::string const& folder);

//! The folder that names in the case file at `path` are relative to: its own or, for the copy in a run folder, that of
//! the case file that the run was started from.
std::string home_of(std::string const& path);

//! Throws base::CaseError with every value in which the case differs from that of the run in `folder`.
void refuse_other_case(std::string const& folder, ResolvedCase const& resolved);

//! True where the run in `folder` is complete up to `end` (s).
bool is_done(std::string const& folder, double end);

//! Marks the summary of a run that did not come to write its end itself.
void mark_failed(std::string const& folder);
}
