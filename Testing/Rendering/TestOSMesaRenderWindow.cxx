// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOSMesaRenderWindow.h"

#include "Support/ErrorObserver.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <thread>

namespace
{

// A green disc whose radius is a quarter of the window's height, on a background of its own.
struct SphereWindow
{
  vtkSmartPointer<vtkRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  int background = 0; // red, 0 to 255

  SphereWindow(int width, int height, int red, vtkRenderWindow* made = vtkOSMesaRenderWindow::New())
    : background(red)
  {
    this->window.TakeReference(made);
    this->window->SetMultiSamples(0);
    this->window->SetSize(width, height);
    this->window->AddRenderer(this->renderer);
    this->renderer->SetBackground(red / 255.0, 0.0, 0.0);
    vtkNew<vtkSphereSource> sphere;
    sphere->SetRadius(1.0);
    sphere->SetThetaResolution(64);
    sphere->SetPhiResolution(64);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(sphere->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->LightingOff();
    actor->GetProperty()->SetColor(0.0, 1.0, 0.0);
    this->renderer->AddActor(actor);
    this->renderer->GetActiveCamera()->ParallelProjectionOn();
    this->renderer->GetActiveCamera()->SetParallelScale(2.0);
  }

  void Check()
  {
    this->window->Render();
    const int width = this->window->GetSize()[0];
    const int height = this->window->GetSize()[1];
    vtkNew<vtkUnsignedCharArray> pixels;
    ASSERT_TRUE(this->window->GetPixelData(0, 0, width - 1, height - 1, 1, pixels));
    ASSERT_EQ(pixels->GetNumberOfTuples(), vtkIdType(width) * height);
    int green = 0;
    int ground = 0;
    for (vtkIdType i = 0; i < pixels->GetNumberOfTuples(); ++i)
    {
      const unsigned char* pixel = pixels->GetPointer(3 * i);
      green += pixel[0] == 0 && pixel[1] == 255 && pixel[2] == 0;
      ground += pixel[0] == this->background && pixel[1] == 0 && pixel[2] == 0;
    }
    const double area = M_PI * height * height / 16.0;
    EXPECT_NEAR(green, area, 0.02 * area);
    EXPECT_EQ(green + ground, width * height);
  }
};

}

TEST(OSMesaRenderWindow, OverridesTheRenderWindowWithoutAnXServer)
{
  if (std::getenv("DISPLAY"))
  {
    GTEST_SKIP() << "there may be an X server";
  }
  vtkNew<vtkRenderWindow> window;
  EXPECT_TRUE(window->IsA("vtkOSMesaRenderWindow")) << window->GetClassName();
}

TEST(OSMesaRenderWindow, ContextIsOpenGL32OrLater)
{
  vtkNew<vtkOSMesaRenderWindow> window;
  EXPECT_EQ(window->GetGenericContext(), nullptr);
  EXPECT_TRUE(window->SupportsOpenGL());
  EXPECT_FALSE(window->IsDirect());
  EXPECT_TRUE(window->IsCurrent());
  int major = 0;
  int minor = 0;
  window->GetOpenGLVersion(major, minor);
  EXPECT_GE(10 * major + minor, 32);
}

TEST(OSMesaRenderWindow, WindowsOfDifferentSizesTakeTurns)
{
  SphereWindow wide(200, 160, 255);
  SphereWindow small(64, 128, 51);
  for (int turn = 0; turn < 2; ++turn)
  {
    wide.Check();
    EXPECT_FALSE(vtkOSMesaRenderWindow::SafeDownCast(small.window)->IsCurrent());
    small.Check();
    EXPECT_FALSE(vtkOSMesaRenderWindow::SafeDownCast(wide.window)->IsCurrent());
  }
}

TEST(OSMesaRenderWindow, WindowsShareAnActor)
{
  SphereWindow first(200, 160, 255);
  SphereWindow second(64, 128, 51);
  second.renderer->RemoveAllViewProps();
  second.renderer->AddActor(first.renderer->GetActors()->GetLastActor());
  for (int turn = 0; turn < 2; ++turn)
  {
    first.Check();
    second.Check();
  }
}

TEST(OSMesaRenderWindow, PopContextTakesBackWhatWasCurrent)
{
  vtkNew<vtkOSMesaRenderWindow> first, second;
  first->MakeCurrent();
  second->PushContext();
  EXPECT_TRUE(second->IsCurrent());
  first->PushContext();
  EXPECT_TRUE(first->IsCurrent());
  first->PopContext();
  EXPECT_TRUE(second->IsCurrent());
  second->PopContext();
  EXPECT_TRUE(first->IsCurrent());
  first->ReleaseCurrent();
  second->PushContext();
  second->PopContext();
  EXPECT_FALSE(second->IsCurrent());
}

TEST(OSMesaRenderWindow, Resizes)
{
  SphereWindow picture(100, 80, 255);
  SphereWindow other(90, 90, 51);
  for (const int height : { 80, 240, 60, 700 })
  {
    picture.window->SetSize(height + 20, height);
    picture.Check();
    other.Check();
  }
}

TEST(OSMesaRenderWindow, HasASizeOfItsOwn)
{
  vtkNew<vtkOSMesaRenderWindow> window;
  EXPECT_EQ(window->GetSize()[0], 300);
  EXPECT_EQ(window->GetSize()[1], 300);
}

TEST(OSMesaRenderWindow, BeginsAnewAfterFinalize)
{
  SphereWindow picture(100, 80, 255);
  picture.Check();
  auto* window = vtkOSMesaRenderWindow::SafeDownCast(picture.window);
  window->Finalize();
  EXPECT_EQ(window->GetGenericContext(), nullptr);
  window->Finalize();
  picture.Check();
}

TEST(OSMesaRenderWindow, OutlivesAnother)
{
  SphereWindow stays(100, 80, 255);
  {
    SphereWindow goes(60, 60, 51);
    stays.Check();
    goes.Check();
  }
  stays.Check();
}

TEST(OSMesaRenderWindow, RendersInAnotherThread)
{
  SphereWindow here(100, 80, 255);
  here.Check();
  std::thread(
    []
    {
      SphereWindow there(120, 90, 51);
      there.Check();
    })
    .join();
  here.Check();
}

TEST(OSMesaRenderWindow, InteractorNeedsNoXServer)
{
  vtkNew<vtkOSMesaRenderWindow> window;
  vtkRenderWindowInteractor* interactor = window->MakeRenderWindowInteractor();
  EXPECT_TRUE(interactor->IsA("vtkGenericRenderWindowInteractor"));
}

TEST(OSMesaRenderWindow, AnInteractorOfOnesOwnRendersIt)
{
  SphereWindow made(80, 60, 255);
  vtkNew<vtkRenderWindowInteractor> interactor; // VTK::RenderingUI has an override of it
  interactor->SetRenderWindow(made.window);
  interactor->Initialize();
  interactor->Render();
  made.Check();
}

TEST(OSMesaRenderWindow, ASizeThatIsTooLargeIsAnError)
{
  SphereWindow made(80, 60, 255);
  vtkNew<freespace::ErrorObserver> errors;
  made.window->AddObserver(vtkCommand::ErrorEvent, errors);
  made.window->SetSize(20000, 20000);
  EXPECT_EQ(errors->Count, 1);
  EXPECT_TRUE(errors->Has("20000x20000"));
  EXPECT_EQ(made.window->GetSize()[0], 80);
  made.Check();
}

TEST(OSMesaRenderWindow, ManyAfterEachOther)
{
  for (int i = 0; i < 20; ++i)
  {
    SphereWindow(40 + i, 40, 255).Check();
  }
}
