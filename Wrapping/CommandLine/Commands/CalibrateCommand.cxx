// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Calibration/BoardCalibration.h"
#include "Session/Session.h"

#include <vtkBoardCalibration.h>
#include <vtkNew.h>
#include <vtkSparseModelWriter.h>

#include <iostream>
#include <memory>
#include <vector>

namespace freespace
{

namespace
{

struct CalibrateSettings
{
  std::vector<std::string> images;
  std::string board;
  std::string output;
  int coefficients = BoardCalibrationOptions().maximumCoefficients;
  bool text = false;
};

void AddOptions(CLI::App& command, CalibrateSettings& settings)
{
  command.add_option("images", settings.images, "Images of the board")
    ->required()
    ->type_name("IMAGES");
  command
    .add_option("--board", settings.board,
      "charuco:COLUMNSxROWS:SQUARE:MARKER:DICTIONARY or chessboard:COLUMNSxROWS:SQUARE "
      "(inner corners)")
    ->required()
    ->type_name("BOARD");
  command.add_option("-o,--output", settings.output, "The folder to write the cameras to")
    ->required()
    ->type_name("MODEL");
  command
    .add_option("--coefficients", settings.coefficients,
      "Maximum number of distortion coefficients: k1 k2 p1 p2 k3")
    ->check(CLI::IsMember({ 0, 1, 2, 4, 5 }))
    ->capture_default_str();
  command.add_flag("--text", settings.text, "Write .txt rather than .bin files");
}

void Calibrate(Session& session, const CalibrateSettings& settings)
{
  vtkNew<vtkBoardCalibration> calibration;
  for (const std::string& image : settings.images)
  {
    calibration->AddFileName(image);
  }
  calibration->SetBoard(settings.board);
  calibration->SetMaximumCoefficients(settings.coefficients);
  session.Run(calibration, "calibrate");
  vtkNew<vtkSparseModelWriter> writer;
  writer->SetInputConnection(calibration->GetOutputPort());
  writer->SetFileName(settings.output);
  writer->SetBinary(!settings.text);
  session.Write(writer);
  calibration->WritePictures(settings.output + "/boards");
  calibration->WriteScene(settings.output + "/scene.json", settings.output);
  session.ThrowIfFailed();
  session.Log("wrote the cameras and images in " + settings.output);
  std::cout << calibration->GetText();
}

}

void AddCalibrateCommand(CLI::App& program, Session& session)
{
  auto settings = std::make_shared<CalibrateSettings>();
  CLI::App* command =
    program.add_subcommand("calibrate", "Find cameras from images of a calibration board");
  AddOptions(*command, *settings);
  command->footer("Writes a COLMAP model, a scene.json for it and, in boards/, the images with the "
                  "corners found.\n"
                  "Example:\n"
                  "  freespace calibrate images/*.jpg --board "
                  "charuco:15x15:0.03:0.0225:DICT_5X5_250 -o cameras\n"
                  "  freespace reconstruct cameras/scene.json -o mesh.ply");
  command->callback(session.Defer([settings, &session]() { Calibrate(session, *settings); }));
}

}
