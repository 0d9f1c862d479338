// The program `granum` as a process of its own: started, asked to stop, waited for, and what it said.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cctype>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace granum::scene
{
inline std::string text_of(std::string const& path)
{
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
}

//! Waits until `happened`; false where it does not within a time that only a hang would need.
inline bool eventually(std::function<bool()> const& happened)
{
    using Clock = std::chrono::steady_clock;
    for (auto const end = Clock::now() + std::chrono::minutes(8); Clock::now() < end;) {
        if (happened()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
}

//! How many living processes have `word` in their command line.
inline int processes_with(std::string const& word)
{
    int found = 0;
    for (auto const& entry : std::filesystem::directory_iterator("/proc")) {
        auto const name = entry.path().filename().string();
        if (std::isdigit(static_cast<unsigned char>(name[0])) == 0) continue;
        found += text_of(entry.path().string() + "/cmdline").find(word) != std::string::npos;
    }
    return found;
}

class Program
{
  public:
    //! Starts `granum` with these words; its streams go to the files `said` and `said`.errors. The test itself may be
    //! an MPI process, so what MPI left in the environment is kept from the child.
    Program(std::vector<std::string> words, std::string said) : said_(std::move(said))
    {
        words.insert(words.begin(), GRANUM_PROGRAM);
        std::vector<char*> arguments, environment;
        for (auto& word : words) arguments.push_back(word.data());
        for (char** entry = environ; *entry; ++entry) {
            std::string const text = *entry;
            bool mpi = false;
            for (auto const* begin : {"OMPI_", "PMIX_", "PRTE_", "ORTE_"}) mpi = mpi || text.starts_with(begin);
            if (!mpi) environment.push_back(*entry);
        }
        arguments.push_back(nullptr);
        environment.push_back(nullptr);
        child_ = fork();
        if (child_ < 0) throw std::runtime_error("cannot start a process");
        if (child_ > 0) return;
        dup2(open(said_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 1);
        dup2(open((said_ + ".errors").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 2);
        execve(GRANUM_PROGRAM, arguments.data(), environment.data());
        _exit(127);
    }
    ~Program()
    {
        if (child_ <= 0) return;
        kill(child_, SIGTERM);  // the ranks go with it
        waitpid(child_, nullptr, 0);
    }
    Program(Program const&) = delete;
    Program& operator=(Program const&) = delete;

    void signal(int number) const { kill(child_, number); }

    //! Its exit status; -1 where it hangs or a signal killed it.
    int wait()
    {
        int status = 0;
        if (!eventually([&] { return waitpid(child_, &status, WNOHANG) == child_; })) return -1;
        child_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    std::string said() const { return text_of(said_); }
    std::string errors() const { return text_of(said_ + ".errors"); }

  private:
    std::string said_;
    pid_t child_ = -1;
};
}
