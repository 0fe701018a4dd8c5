// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ColmapRecords_h
#define freespace_ColmapRecords_h

#include "SparseModel/SparseModel.h"

namespace freespace
{

// The records of COLMAP's files, once for text and binary, reading and writing. An archive has
//
//   Value(number, what)              a number; `what` names it in errors
//   Model(camera), Name(text)        a camera's model, the name of an image
//   Observed(id)                     the id of a point or none
//   Fixed(list, what)                a known number of values
//   List(list, bytes, each)          records to the end of a line, or after their count, which take at
//                                    least `bytes` each; each(record) visits one
//   NextLine()                       where text goes on in another line
//
// Records are const where an archive writes.

template <typename Archive, typename Camera>
void VisitCamera(Archive& archive, Camera& camera)
{
  archive.Value(camera.id, "a camera's id");
  archive.Model(camera);
  archive.Value(camera.width, "a width");
  archive.Value(camera.height, "a height");
  archive.Fixed(camera.parameters, "a camera's parameter");
}

/// What stands before an image's observations.
template <typename Archive, typename Image>
void VisitImage(Archive& archive, Image& image)
{
  archive.Value(image.id, "an image's id");
  archive.Fixed(image.rotation, "a part of a quaternion");
  archive.Fixed(image.translation, "a part of a translation");
  archive.Value(image.camera, "a camera's id");
  archive.Name(image.name);
}

template <typename Archive, typename Image>
void VisitObservations(Archive& archive, Image& image)
{
  archive.List(image.observations, 2 * 8 + 8,
    [&](auto& observation)
    {
      archive.Value(observation.pixel.x(), "an observation's x");
      archive.Value(observation.pixel.y(), "an observation's y");
      archive.Observed(observation.point);
    });
}

/// What stands before a point's track.
template <typename Archive, typename Point>
void VisitPoint(Archive& archive, Point& point)
{
  archive.Value(point.id, "a point's id");
  archive.Fixed(point.position, "a coordinate");
  archive.Fixed(point.color, "a colour from 0 to 255");
  archive.Value(point.error, "a reprojection error");
}

template <typename Archive, typename Point>
void VisitTrack(Archive& archive, Point& point)
{
  archive.List(point.track, 4 + 4,
    [&](auto& element)
    {
      archive.Value(element.image, "an image's id");
      archive.Value(element.observation, "the index of an observation");
    });
}

}

#endif
