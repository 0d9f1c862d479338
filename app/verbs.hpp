// The verbs of the program: each adds itself to the command line and does its work, giving the exit status.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <string>

namespace granum::app
{
using Action = std::function<int()>;

//! Each makes its subcommand and sets `action` when it was chosen.
void add_run(CLI::App& program, Action& action);
void add_check(CLI::App& program, Action& action);
void add_explain(CLI::App& program, Action& action);
void add_balance(CLI::App& program, Action& action);
void add_list(CLI::App& program, Action& action);
void add_new(CLI::App& program, Action& action);
void add_report(CLI::App& program, Action& action);
void add_map(CLI::App& program, Action& action);
void add_scale(CLI::App& program, Action& action);
void add_study(CLI::App& program, Action& action);
void add_project(CLI::App& program, Action& action);
void add_compare(CLI::App& program, Action& action);

//! `granum run CASE -o FOLDER -n RANKS --until UNTIL --quiet`, in processes of its own; its exit status. Ranks 0:
//! as that chooses. Throws as launch_ranks.
int run_case(std::string const& file, std::string const& folder, double until, int ranks);
}
