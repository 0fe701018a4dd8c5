// SPDX-License-Identifier: BSD-3-Clause
#include "Stages/ContourPieces.h"

#include "Session/Interrupts.h"
#include "Session/Session.h"
#include "Sharing/SharedWork.h"

#include <vtkBisectionContourFilter.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#ifdef FREESPACE_HAS_MPI
#include <vtkCharArray.h>
#include <vtkCommunicator.h>
#endif

#include <string>

namespace freespace
{

namespace
{

// For each process, so that those that are done early find something left to do.
constexpr int PiecesEach = 4;

#ifdef FREESPACE_HAS_MPI

std::string BytesOfPiece(vtkPolyData* piece)
{
  vtkNew<vtkCharArray> bytes;
  vtkCommunicator::MarshalDataObject(piece, bytes);
  return { bytes->GetPointer(0), static_cast<std::size_t>(bytes->GetNumberOfValues()) };
}

void PieceOfBytes(const std::string& bytes, vtkPolyData* piece)
{
  vtkNew<vtkCharArray> array;
  array->SetArray(const_cast<char*>(bytes.data()), static_cast<vtkIdType>(bytes.size()), 1);
  vtkCommunicator::UnMarshalDataObject(array, piece);
}

#else

// Nothing is shared without MPI.
std::string BytesOfPiece(vtkPolyData*)
{
  return {};
}

void PieceOfBytes(const std::string&, vtkPolyData*) {}

#endif

void OnPieceProgress(vtkObject* contour, unsigned long, void* stop, void*)
{
  if (*static_cast<const CancellationFlag*>(stop))
  {
    vtkAlgorithm::SafeDownCast(contour)->SetAbortExecute(1);
  }
}

void MakePiece(Session& session, vtkBisectionContourFilter* contour, int piece, int pieces,
  const CancellationFlag& stop)
{
  vtkNew<vtkCallbackCommand> onProgress;
  onProgress->SetCallback(OnPieceProgress);
  onProgress->SetClientData(const_cast<CancellationFlag*>(&stop));
  const unsigned long tag = contour->AddObserver(vtkCommand::ProgressEvent, onProgress);
  contour->UpdatePiece(piece, pieces, 0);
  contour->RemoveObserver(tag);
  ThrowIfCancelled(stop);
  session.ThrowIfFailed();
}

}

std::vector<vtkSmartPointer<vtkPolyData>> MakePieces(
  Session& session, vtkBisectionContourFilter* contour)
{
  const int count = PiecesEach * session.Shared()->Count();
  std::vector<vtkSmartPointer<vtkPolyData>> pieces(session.IsWriter() ? count : 0);
  SharedLoop loop;
  loop.work.assign(static_cast<std::size_t>(count), 1.0);
  loop.isForFirst = true;
  loop.make = [&](std::size_t i, const CancellationFlag& stop) -> std::string
  {
    MakePiece(session, contour, static_cast<int>(i), count, stop);
    if (!session.IsWriter())
    {
      return BytesOfPiece(contour->GetOutput());
    }
    pieces[i] = vtkSmartPointer<vtkPolyData>::New();
    pieces[i]->ShallowCopy(contour->GetOutput());
    return {};
  };
  loop.take = [&](std::size_t i, const std::string& bytes)
  {
    pieces[i] = vtkSmartPointer<vtkPolyData>::New();
    PieceOfBytes(bytes, pieces[i]);
  };
  // A piece uses all threads, and the progress is that of the pieces of all processes.
  vtkNew<vtkObject> teller;
  const Progress progress(
    [&](double fraction)
    {
      teller->InvokeEvent(vtkCommand::ProgressEvent, &fraction);
      return Interrupt() == 0;
    });
  session.Watch(teller, "contour", [&] { session.Shared()->Do(loop, SerialFor, progress); });
  return pieces;
}

}
