/* SPDX-License-Identifier: BSD-3-Clause */
/* Preloaded: before the call number KILL_AT that moves or removes a file or folder, the process is killed; before
 * the call number STOP_AT it stops, until it is told to go on. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

static int IsAt(const char* variable, int call)
{
  const char* at = getenv(variable);
  return at && call == atoi(at);
}

static void CountCall(void)
{
  static int calls = 0;
  const int call = __sync_add_and_fetch(&calls, 1);
  if (IsAt("KILL_AT", call))
  {
    kill(getpid(), SIGKILL);
    pause();
  }
  if (IsAt("STOP_AT", call))
  {
    kill(getpid(), SIGSTOP);
  }
}

#define NEXT(type, name) ((type)dlsym(RTLD_NEXT, name))

int rename(const char* from, const char* to)
{
  CountCall();
  return NEXT(int (*)(const char*, const char*), "rename")(from, to);
}

int renameat(int fromFolder, const char* from, int toFolder, const char* to)
{
  CountCall();
  return NEXT(int (*)(int, const char*, int, const char*), "renameat")(fromFolder, from, toFolder, to);
}

int link(const char* from, const char* to)
{
  CountCall();
  return NEXT(int (*)(const char*, const char*), "link")(from, to);
}

int symlink(const char* target, const char* path)
{
  CountCall();
  return NEXT(int (*)(const char*, const char*), "symlink")(target, path);
}

int unlink(const char* path)
{
  CountCall();
  return NEXT(int (*)(const char*), "unlink")(path);
}

int unlinkat(int folder, const char* path, int flags)
{
  CountCall();
  return NEXT(int (*)(int, const char*, int), "unlinkat")(folder, path, flags);
}

int rmdir(const char* path)
{
  CountCall();
  return NEXT(int (*)(const char*), "rmdir")(path);
}

int remove(const char* path)
{
  CountCall();
  return NEXT(int (*)(const char*), "remove")(path);
}
