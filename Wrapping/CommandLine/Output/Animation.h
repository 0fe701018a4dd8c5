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

/// Pictures one after the other as an Ogg Theora film, the one format for which VTK brings a writer
/// everywhere. The file is made beside its target and renamed by Finish.
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

  /// Whether the ending of a file's name is that of a film.
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
