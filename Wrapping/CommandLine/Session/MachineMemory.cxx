// SPDX-License-Identifier: BSD-3-Clause
#include "Session/MachineMemory.h"

#include <unistd.h>

namespace freespace
{

double ShareOfMemory()
{
  const double pages = static_cast<double>(sysconf(_SC_PHYS_PAGES));
  return 0.75 * pages * sysconf(_SC_PAGESIZE) / (1024 * 1024);
}

}
