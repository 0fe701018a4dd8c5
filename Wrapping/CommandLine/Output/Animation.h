// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Animation_h
#define freespace_Animation_h

#include "Files/AtomicOutput.h"

#include <vtkNew.h>
#include <vtkOggTheoraWriter.h>

#include <string>

class vtkImageData;

namespace freespace
{

class Session;

/// A sequence of pictures as an Ogg Theora film, the only format for which every VTK has a writer. The file is made
/// beside its target and renamed by Finish.
class Animation
{
public:
  /// `rate` is in pictures a second. Throws Error when the file's folder cannot be written.
  Animation(const std::string& fileName, int rate);
  ~Animation();

  /// Adds a picture; all are of one size. Throws Error when it cannot be written.
  void Add(Session& session, vtkImageData* picture);

  /// Ends the film. Throws Error when it cannot be written, or no picture was added.
  void Finish(Session& session);

  /// Whether a file name has the extension of a film.
  static bool CanWriteFile(const std::string& fileName);

private:
  void Check(Session& session);

  std::string FileName;
  AtomicOutput Target;
  vtkNew<vtkOggTheoraWriter> Writer;
  bool IsStarted = false;
};

}

#endif
