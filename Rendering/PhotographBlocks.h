// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_PhotographBlocks_h
#define freespace_PhotographBlocks_h

#include "Texture/Photograph.h"

class vtkMultiBlockDataSet;

namespace freespace
{

/// The images of a vtkPhotographReader. Throws Error naming the block that is not an image of
/// three or four unsigned chars with a camera of its size.
std::vector<Photograph> PhotographsFromBlocks(vtkMultiBlockDataSet* blocks);

}

#endif
