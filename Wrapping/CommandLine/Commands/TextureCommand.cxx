// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Common/Error.h"
#include "Output/SurfaceFiles.h"
#include "Scene/Scene.h"
#include "Session/MachineMemory.h"
#include "Session/NumberValidators.h"
#include "Session/Session.h"
#include "Texture/Photograph.h"
#include "Texture/TextureAtlas.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPhotographReader.h>
#include <vtkPolyData.h>
#include <vtkTextureBaker.h>
#include <vtkTexturedSurfaceWriter.h>

#include <cmath>
#include <memory>
#include <sstream>
#include <string>

namespace freespace
{

namespace
{

struct TextureSettings
{
  std::string mesh;
  std::string scene;
  std::string output;
  double texel = TextureAtlasOptions().texel;
  int largest = TextureAtlasOptions().largest;
  double memoryLimit = -1; // below 0: a share of the machine's
};

void AddOptions(CLI::App& command, TextureSettings& settings)
{
  command.add_option("mesh", settings.mesh, "The surface (.ply .stl .obj .vtp)")
    ->required()
    ->type_name("MESH.ply");
  command.add_option("--scene", settings.scene, "The scene, or the model, whose images colour it")
    ->required()
    ->type_name("SCENE.json|MODEL");
  command
    .add_option("-o,--output", settings.output,
      "The model to write: .glb, .obj with .mtl and .png, or .ply with colours of points")
    ->required()
    ->type_name("MODEL.glb");
  command
    .add_option(
      "--texel", settings.texel, "Side of a texel in the scene's unit (0: as fine as the images)")
    ->check(NonNegative())
    ->capture_default_str();
  command.add_option("--largest", settings.largest, "Longest side of the texture, texels")
    ->check(CLI::Range(16, 32768))
    ->capture_default_str();
  command
    .add_option("--memory-limit", settings.memoryLimit,
      "Limit of the memory for the images and the texture, MiB, for which texels become larger; 0: "
      "no limit; default: three quarters of the memory of the machine")
    ->check(NonNegative());
}

// Before the images are read. Throws Error where they alone exceed the limit.
void CheckMemory(const TextureSettings& settings, double limit)
{
  const Scene scene = ReadScene(settings.scene);
  double pixels = 0;
  for (const CalibratedImage& image : PresentImages(scene, ReadSceneImages(scene)))
  {
    pixels += static_cast<double>(image.camera.width) * image.camera.height;
  }
  const double needed = pixels * MemoryOfPixel / (1 << 20);
  if (limit > 0 && needed >= limit)
  {
    throw Error("The images of " + settings.scene + " take " + std::to_string(std::lround(needed)) +
      " MiB, and the limit of the memory is " + std::to_string(std::lround(limit)) +
      " MiB (--memory-limit).");
  }
}

void Texture(Session& session, const TextureSettings& settings)
{
  if (!vtkTexturedSurfaceWriter::CanWriteFile(settings.output))
  {
    throw Error(
      "Cannot write '" + settings.output + "': a model's file name ends in .glb, .obj or .ply.");
  }
  CheckOutputFolder(settings.output);
  const double limit = settings.memoryLimit < 0 ? ShareOfMemory() : settings.memoryLimit;
  const auto surface = ReadSurface(session, settings.mesh);
  CheckMemory(settings, limit);
  vtkNew<vtkPhotographReader> photographs;
  photographs->SetFileName(settings.scene);
  session.Run(photographs, "images");
  vtkNew<vtkTextureBaker> baker;
  baker->SetInputDataObject(surface);
  baker->SetPhotographs(photographs->GetOutput());
  baker->SetTexelSize(settings.texel);
  baker->SetLargestTexture(settings.largest);
  baker->SetMemoryLimit(limit);
  session.Run(baker, "texture");
  if (baker->GetNumberOfCharts() == 0)
  {
    throw Error("No image of " + settings.scene + " sees the surface: it is of another place.");
  }
  const int* size = baker->GetTexture()->GetDimensions();
  std::ostringstream told;
  told << baker->GetNumberOfCharts() << " charts, " << size[0] << " x " << size[1]
       << " texels of side " << baker->GetBakedTexelSize();
  session.Log(told.str());
  vtkNew<vtkTexturedSurfaceWriter> writer;
  writer->SetInputDataObject(0, baker->GetOutput());
  writer->SetInputDataObject(1, baker->GetTexture());
  writer->SetFileName(settings.output);
  session.Write(writer);
  session.Log("wrote " + settings.output);
}

}

void AddTextureCommand(CLI::App& program, Session& session)
{
  auto settings = std::make_shared<TextureSettings>();
  CLI::App* command =
    program.add_subcommand("texture", "Give a surface a texture that other programs can show");
  AddOptions(*command, *settings);
  command->footer("Examples:\n"
                  "  freespace texture mesh.ply --scene scene.json -o model.glb\n"
                  "  freespace texture mesh.ply --scene scene.json -o model.obj");
  command->callback(session.Defer([settings, &session]() { Texture(session, *settings); }));
}

}
