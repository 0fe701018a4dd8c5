// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSparseModelWriter
 * @brief write views as a COLMAP model
 *
 * Writes the cameras, images and points of views to a folder, as COLMAP's programs read them: as
 * cameras.txt, images.txt and points3D.txt, or as .bin. The folder is created if only its last component
 * is missing. The files are written to a temporary folder and renamed; files of the other format are
 * removed, since they would belong to another model.
 *
 * Views from vtkSparseModelReader are written with their numbers, lenses, tracks and keypoints unchanged.
 * Other views, for instance those of vtkEdgeStereoReader, become images with a pinhole camera each, and
 * their features points that one image observes.
 *
 * A folder that cannot be written, a block that is not a view, and two views of the same image are errors
 * that name the folder or view; Write() then returns 0.
 *
 * @sa vtkSparseModelReader vtkBoardCalibration
 */
#ifndef vtkSparseModelWriter_h
#define vtkSparseModelWriter_h

#include "vtkFreespaceWritersModule.h" // for the export macro
#include "vtkFreespaceSetGet.h"        // for file names
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
  vtkSetFilePathStringMacro(FileName);
  vtkGetFilePathStringMacro(FileName);
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
