// SPDX-License-Identifier: BSD-3-Clause
#ifndef PlainSettings_h
#define PlainSettings_h

/// The settings with which results are known in closed form: a point is free where one view sees it so, the
/// hull is pushed out by a hundredth of its diagonal.
template <typename Union>
void SetPlain(Union* phi)
{
  phi->SetMinimumViews(1);
  phi->SetHullMargin(0.01);
}

/// A fixed lattice, the surface as marching cubes makes it, all components.
template <typename Contour>
void SetPlainContour(Contour* contour)
{
  contour->SetCells(256);
  contour->SetSharpEdges(false);
  contour->SetCrumbs(true);
}

/// SetPlain for the options of the core.
template <typename Options>
Options Plain(Options options)
{
  options.minimumViews = 1;
  options.hullMargin = 0.01;
  return options;
}

#endif
