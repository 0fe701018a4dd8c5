// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSparseModelWriter
 * @brief write views as a COLMAP model
 *
 * Writes the cameras, images and points of views into a folder, as COLMAP's programs read them: as
 * cameras.txt, images.txt and points3D.txt, or as .bin. The folder is made when only its last part
 * is missing. The files are made in a folder of their own and then renamed; files of the other
 * format are removed, since they would stand for another model.
 *
 * Views that vtkSparseModelReader read are written with their numbers, lenses, tracks and keypoints
 * as they were. Other views, those of vtkEdgeStereoReader for instance, become images with a
 * pinhole camera each, their features points that one image sees.
 *
 * A folder that cannot be written, a block that is no view, and two views with the same image are
 * errors that name the folder or view; Write() then returns 0.
 */
#ifndef vtkSparseModelWriter_h
#define vtkSparseModelWriter_h

#include "vtkFreespaceWritersModule.h" // for the export macro
#include "vtkWriter.h"

#include <string> // for FileName

class VTKFREESPACEWRITERS_EXPORT vtkSparseModelWriter : public vtkWriter
{
public:
  static vtkSparseModelWriter* New();
  vtkTypeMacro(vtkSparseModelWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The folder to write to.
   */
  vtkSetMacro(FileName, std::string);
  vtkGetMacro(FileName, std::string);
  ///@}

  ///@{
  /**
   * Whether to write .bin rather than .txt files. Default on.
   */
  vtkSetMacro(Binary, vtkTypeBool);
  vtkGetMacro(Binary, vtkTypeBool);
  vtkBooleanMacro(Binary, vtkTypeBool);
  ///@}

protected:
  vtkSparseModelWriter() = default;
  ~vtkSparseModelWriter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

  std::string FileName;
  vtkTypeBool Binary = 1;

private:
  vtkSparseModelWriter(const vtkSparseModelWriter&) = delete;
  void operator=(const vtkSparseModelWriter&) = delete;
};

#endif
