// The errors of the house, each with the exit code that the program ends with.
//
// A wrong case is a list of Mistakes (all of a file, found in one pass); everything else is one message.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace granum::base
{
enum class Exit : int
{
    done = 0,
    usage = 2,
    numerics = 70,
    io = 74,
    stopped = 75,
    interrupted = 130
};

//! Thrown for anything that ends the program; `exit` is its status.
struct Error : std::runtime_error
{
    Exit exit;
    Error(Exit code, std::string const& what) : std::runtime_error(what), exit(code) {}
};

//! One wrong entry of a case file, in the grammar "file:line: key = value is not ...".
struct Mistake
{
    std::string file;                //!< path as the user typed it
    int line = 0;                    //!< 1-based; 0 where the mistake has no line (a missing file)
    std::string entry;               //!< `key = value` as written, or the key alone
    std::string what;                //!< what is wrong, to be read after the entry
    std::vector<std::string> hints;  //!< known or allowed values, likely fix: one line each

    std::string text() const
    {
        std::string out = line > 0 ? fmt::format("{}:{}: ", file, line) : file.empty() ? "" : fmt::format("{}: ", file);
        out += entry.empty() ? what : fmt::format("{} {}", entry, what);
        for (auto const& hint : hints) out += "\n  " + hint;
        return out;
    }
};

//! A case that cannot be run: every mistake of the file.
struct CaseError : Error
{
    std::vector<Mistake> mistakes;
    explicit CaseError(std::vector<Mistake> all) : Error(Exit::usage, join(all)), mistakes(std::move(all)) {}

  private:
    static std::string join(std::vector<Mistake> const& all)
    {
        std::string out;
        for (auto const& mistake : all) {
            if (!out.empty()) out += '\n';
            out += mistake.text();
        }
        return out;
    }
};

//! Physics or numerics that cannot go on (non-finite state, overlap, ledger).
struct NumericsError : Error
{
    explicit NumericsError(std::string const& what) : Error(Exit::numerics, what) {}
};

struct IoError : Error
{
    explicit IoError(std::string const& what) : Error(Exit::io, what) {}
};

//! Always on: a condition that a user, a file or the machine can break.
template <class... Arguments>
void require(bool condition, fmt::format_string<Arguments...> what, Arguments&&... arguments)
{
    if (!condition) throw NumericsError(fmt::format(what, std::forward<Arguments>(arguments)...));
}
}

// A condition that only a defect of ours can break; compiled into debug and audit builds.
#ifdef GRANUM_CHECKS
#define GRANUM_EXPECT(condition)                                                           \
    do {                                                                                   \
        if (!(condition))                                                                  \
            throw ::granum::base::NumericsError(                                           \
                fmt::format("{}:{}: broken promise: {}", __FILE__, __LINE__, #condition)); \
    } while (false)
#else
#define GRANUM_EXPECT(condition) static_cast<void>(0)
#endif
