// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ImageAgreement_h
#define freespace_ImageAgreement_h

#include <utility>
#include <vector>

namespace freespace
{

/// How well the edges of one image agree with those of its neighbours, given their cameras.
struct ImageAgreement
{
  int image = 0;        ///< the reference of the match, an index
  double tokens = 0;    ///< of its edges that were looked for
  double confirmed = 0; ///< of these, tokens that two other images show in one place
  /// The other images, and how many of the confirmed tokens each of them shows.
  std::vector<std::pair<int, double>> others;
};

/// The classification of the images, by their indices in ascending order.
struct Agreement
{
  std::vector<int> confirmed;    ///< that others agree with
  std::vector<int> contradicted; ///< that more others contradict
  std::vector<int> unknown;      ///< that could not be compared
};

/// Finds the images that contradict the others: those that are upside down or under another's name,
/// and cameras with a wrong pose.
///
/// A right image whose neighbours are right has many confirmed tokens, and is itself among those that
/// confirm the tokens of its neighbours. Two images agree when each shows a good part of the tokens that
/// the other has confirmed. Images that agree, directly or by way of others, form groups. Contradicted are
/// those of a group of which one does not agree with one of a larger group, although they were compared.
/// The comparison does not count for an image of which nothing is confirmed, unless two of those that it
/// was matched with agree with each other.
///
/// agreements: one for each image at most.
Agreement FindAgreement(std::size_t images, const std::vector<ImageAgreement>& agreements);

}

#endif
