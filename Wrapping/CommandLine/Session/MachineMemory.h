// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_MachineMemory_h
#define freespace_MachineMemory_h

namespace freespace
{

/// Three quarters of the machine's memory, MiB: the default of limits.
double ShareOfMemory();

}

#endif
