// SPDX-License-Identifier: BSD-3-Clause
#include "Batch/StepProcess.h"

#include "Common/Error.h"

#include <csignal>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace freespace
{

namespace
{

constexpr int notStarted = 127;

// In the child: only what may be called between fork and exec.
[[noreturn]] void Become(char* const* arguments, const char* folder, int log, int parent)
{
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  const int input = open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (getppid() == parent && input >= 0 && dup2(input, 0) == 0 && dup2(log, 1) == 1 &&
    dup2(log, 2) == 2 && chdir(folder) == 0)
  {
    execv("/proc/self/exe", arguments);
  }
  _exit(notStarted);
}

int StatusOf(int waited)
{
  return WIFEXITED(waited) ? WEXITSTATUS(waited) : 128 + WTERMSIG(waited);
}

}

int StartProgram(
  const std::vector<std::string>& arguments, const std::string& folder, const std::string& log)
{
  std::vector<std::string> words = { "freespace" };
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words)
  {
    pointers.push_back(word.data());
  }
  pointers.push_back(nullptr);
  const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0)
  {
    throw Error("Cannot write '" + log + "'.");
  }
  const int parent = getpid();
  const int process = fork();
  if (process == 0)
  {
    Become(pointers.data(), folder.c_str(), file, parent);
  }
  close(file);
  if (process < 0)
  {
    throw Error("Cannot start another process: the machine has too many.");
  }
  return process;
}

bool HasEnded(const std::vector<int>& processes, StepEnd& end)
{
  for (const int process : processes)
  {
    int waited = 0;
    rusage usage = {};
    if (wait4(process, &waited, WNOHANG, &usage) == process)
    {
      end = { process, StatusOf(waited), usage.ru_maxrss / 1024.0 };
      return true;
    }
  }
  return false;
}

void StopAll(const std::vector<int>& processes)
{
  for (const int process : processes)
  {
    kill(process, SIGTERM);
  }
  for (const int process : processes)
  {
    int waited = 0;
    waitpid(process, &waited, 0);
  }
}

}
