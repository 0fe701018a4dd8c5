// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ImageBlocks_h
#define freespace_ImageBlocks_h

#include "Scene/MemoryScene.h"

#include <vector>

class vtkMultiBlockDataSet;

namespace freespace
{

/// The images of blocks of vtkImageData with the field data of their cameras, as vtkPhotographReader generates
/// them: grey or colour with or without alpha, the bottom row first; more than 8 bits are brought to 8 (EightBits).
/// Throws Error naming the block that is none.
std::vector<MemoryImage> ImagesFromBlocks(vtkMultiBlockDataSet* blocks);

}

#endif
