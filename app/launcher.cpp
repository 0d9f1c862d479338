#include "launcher.hpp"

#include "granum/base/error.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace granum::app
{
namespace
{
// The ranks leave their status in a file: a status other than 0 would make mpirun add its own page of words.
constexpr char const* status_file = "GRANUM_STATUS_FILE";

volatile std::sig_atomic_t signals = 0;
volatile pid_t child = 0;

void pass_on(int)
{
    signals = signals + 1;
    if (child > 0 && signals == 1) kill(child, SIGUSR1);  // mpirun hands it to every rank
}

void pass_on_checkpoint(int)
{
    if (child > 0) kill(child, SIGUSR2);
}

std::vector<pid_t> descendants(pid_t of)
{
    std::vector<pid_t> all;
    std::ifstream children(fmt::format("/proc/{0}/task/{0}/children", of));
    for (pid_t one; children >> one;) {
        all.push_back(one);
        auto const below = descendants(one);
        all.insert(all.end(), below.begin(), below.end());
    }
    return all;
}

void end_at_once()
{
    auto const ranks = descendants(child);
    kill(child, SIGKILL);
    for (pid_t const rank : ranks) kill(rank, SIGKILL);
}

[[noreturn]] void become_mpirun(int ranks, std::string const& program, std::vector<std::string> const& arguments,
                                bool terminal)
{
    setpgid(0, 0);  // the keyboard reaches the parent only, which decides
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (int const nothing = open("/dev/null", O_RDONLY); nothing >= 0) dup2(nothing, 0);
    setenv("GRANUM_RANK", "1", 1);
    setenv("GRANUM_TERMINAL", terminal ? "1" : "0", 1);
    for (auto const* name : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"}) setenv(name, "1", 1);
    setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 1);  // containers forbid it, with a warning per run
    setenv("OMPI_MCA_mpi_yield_when_idle", "1", 1);                 // waiting ranks leave the core to whoever has work
    std::vector<std::string> words{"mpirun", "--quiet",         "-n",   std::to_string(ranks), "--bind-to",
                                   "none",   "--oversubscribe", program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> raw;
    for (auto& word : words) raw.push_back(word.data());
    raw.push_back(nullptr);
    execvp("mpirun", raw.data());
    _exit(127);
}
}

int launch_ranks(int ranks, std::vector<std::string> const& arguments)
{
    // A folder that only this user can enter, so that nobody else can write the status.
    auto folder = (std::filesystem::temp_directory_path() / "granum-XXXXXX").string();
    if (!mkdtemp(folder.data())) throw base::IoError(fmt::format("cannot make {}: {}", folder, std::strerror(errno)));
    auto const name = folder + "/status";
    setenv(status_file, name.c_str(), 1);

    struct sigaction action = {};
    action.sa_handler = pass_on;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    action.sa_handler = pass_on_checkpoint;
    sigaction(SIGUSR2, &action, nullptr);

    auto const self = std::filesystem::read_symlink("/proc/self/exe").string();
    bool const terminal = isatty(1) && isatty(2);
    pid_t const started = fork();
    if (started < 0) throw base::IoError(fmt::format("cannot start the ranks: {}", std::strerror(errno)));
    if (started == 0) become_mpirun(ranks, self, arguments, terminal);
    child = started;
    if (signals > 0) kill(started, SIGUSR1);

    int wait_status = 0;
    bool ended = false;
    while (waitpid(started, &wait_status, 0) < 0 && errno == EINTR)
        if (signals > 1 && !ended) {
            end_at_once();
            ended = true;
        }
    child = 0;

    int said = -1;
    std::ifstream(name) >> said;
    std::filesystem::remove_all(folder);
    if (ended) return static_cast<int>(base::Exit::interrupted);
    if (said >= 0) return said;
    if (WIFEXITED(wait_status) && WEXITSTATUS(wait_status) == 127)
        throw base::IoError("cannot start mpirun; install Open MPI, or run on one rank with -n 1");
    throw base::NumericsError("the ranks ended without a word; see the log in the run folder");
}

bool started_by_launcher()
{
    return std::getenv("GRANUM_RANK") != nullptr;
}

bool tell_launcher(int status)
{
    char const* path = std::getenv(status_file);
    if (!path) return true;
    int const file = open(path, O_WRONLY | O_CREAT | O_EXCL, 0600);
    if (file < 0) return false;
    auto const text = std::to_string(status) + "\n";
    bool const written = write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    close(file);
    return written;
}
}
