// SPDX-License-Identifier: BSD-3-Clause
#include "Output/Animation.h"

#include "Common/Error.h"
#include "Files/FileExtension.h"
#include "Session/Session.h"

#include <vtkImageData.h>

namespace freespace
{

namespace
{

constexpr int best = 2; // of the writer's qualities 0, 1 and 2

}

Animation::Animation(const std::string& fileName, int rate)
  : FileName(fileName)
  , Target(fileName)
{
  this->Writer->SetFileName(this->Target.Path().c_str());
  this->Writer->SetRate(rate);
  this->Writer->SetQuality(best);
  // Colours at half the resolution, 4:2:0, as every player expects: players are known to crash on 4:4:4
  // of sizes that are no multiples of 16.
  this->Writer->SubsamplingOn();
}

Animation::~Animation()
{
  if (this->IsStarted)
  {
    this->Writer->End();
  }
}

void Animation::Add(Session& session, vtkImageData* picture)
{
  this->Writer->SetInputData(picture);
  if (!this->IsStarted)
  {
    this->Writer->Start();
    this->Check(session);
    this->IsStarted = true;
  }
  this->Writer->Write();
  this->Check(session);
}

void Animation::Finish(Session& session)
{
  if (!this->IsStarted)
  {
    throw Error("Cannot write " + this->FileName + ": there is no picture for it.");
  }
  this->Writer->End();
  this->IsStarted = false;
  this->Check(session);
  this->Target.Commit();
}

void Animation::Check(Session& session)
{
  session.ThrowIfFailed();
  if (this->Writer->GetError() != 0)
  {
    throw Error("Cannot write " + this->FileName + ": " +
      vtkGenericMovieWriter::GetStringFromErrorCode(this->Writer->GetError()) + ".");
  }
}

bool Animation::CanWriteFile(const std::string& fileName)
{
  return LowerCaseExtension(fileName) == ".ogv";
}

}
