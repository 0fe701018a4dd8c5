/* SPDX-License-Identifier: BSD-3-Clause */
/* Preloaded: kills the process before the call number KILL_AT that moves or removes a file. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

static void CountCall(void)
{
  static int calls = 0;
  const char* at = getenv("KILL_AT");
  if (at && __sync_add_and_fetch(&calls, 1) == atoi(at))
  {
    kill(getpid(), SIGKILL);
    pause();
  }
}

int rename(const char* from, const char* to)
{
  CountCall();
  return ((int (*)(const char*, const char*))dlsym(RTLD_NEXT, "rename"))(from, to);
}

int link(const char* from, const char* to)
{
  CountCall();
  return ((int (*)(const char*, const char*))dlsym(RTLD_NEXT, "link"))(from, to);
}

int unlink(const char* path)
{
  CountCall();
  return ((int (*)(const char*))dlsym(RTLD_NEXT, "unlink"))(path);
}

int unlinkat(int folder, const char* path, int flags)
{
  CountCall();
  return ((int (*)(int, const char*, int))dlsym(RTLD_NEXT, "unlinkat"))(folder, path, flags);
}

int remove(const char* path)
{
  CountCall();
  return ((int (*)(const char*))dlsym(RTLD_NEXT, "remove"))(path);
}
