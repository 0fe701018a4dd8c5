// SPDX-License-Identifier: BSD-3-Clause
#include "Output/PictureComparison.h"

#include "Files/AtomicOutput.h"
#include "Common/Error.h"
#include "Data/PngBytes.h"
#include "Session/Session.h"

#include <vtkImageData.h>
#include <vtkImageDifference.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <sstream>

namespace freespace
{

namespace
{

vtkSmartPointer<vtkImageData> ReadPicture(Session& session, const std::string& fileName)
{
  vtkNew<vtkPNGReader> reader;
  if (!reader->CanReadFile(fileName.c_str()))
  {
    throw Error("'" + fileName + "' cannot be read as a PNG file.");
  }
  reader->SetFileName(fileName.c_str());
  session.Run(reader, "read");
  vtkSmartPointer<vtkImageData> picture = reader->GetOutput();
  if (picture->GetScalarType() != VTK_UNSIGNED_CHAR || picture->GetNumberOfScalarComponents() != 3)
  {
    throw Error("'" + fileName + "' is no picture of red, green and blue with 8 bits each.");
  }
  return picture;
}

void WriteDifference(vtkImageData* picture, const std::string& fileName)
{
  AtomicOutput target(fileName);
  const auto bytes = PngBytes(picture);
  target.Write(bytes->GetPointer(0), bytes->GetNumberOfValues());
  target.Commit();
}

}

void ComparePictures(Session& session, const std::string& fileName, const std::string& reference,
  const std::string& difference, double largest)
{
  const auto made = ReadPicture(session, fileName), expected = ReadPicture(session, reference);
  if (!std::equal(made->GetDimensions(), made->GetDimensions() + 3, expected->GetDimensions()))
  {
    throw Error("'" + fileName + "' and '" + reference + "' are of different sizes.");
  }
  vtkNew<vtkImageDifference> compared;
  compared->SetInputData(made);
  compared->SetImageData(expected);
  session.Run(compared, "compare");
  if (!difference.empty())
  {
    WriteDifference(compared->GetOutput(), difference);
    session.Log("wrote " + difference);
  }
  std::ostringstream sentence;
  sentence << "'" << fileName << "' differs from '" << reference << "' by "
           << compared->GetThresholdedError();
  if (!(compared->GetThresholdedError() <= largest))
  {
    sentence << ", more than " << largest << ".";
    throw Error(sentence.str());
  }
  session.Log(sentence.str());
}

}
