// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_CandidateSearch_h
#define freespace_CandidateSearch_h

#include "Edges/SideColors.h"
#include "Epipolar/EpipolarIndex.h"
#include "Epipolar/EpipolarRays.h"
#include "Matching/EdgeHypothesis.h"
#include "Matching/EdgeMatch.h"
#include "Matching/MatcherOptions.h"
#include "Matching/ProximityBins.h"

#include <cstddef>
#include <vector>

namespace freespace
{

/// Searches the other images for the edges that may show the same edge in space as a token of the
/// reference: the first step of trinocular matching (see MatchEdges).
///
/// Candidates lie on the epipolar line of the token, within the disparity range, have a similar
/// direction and similar colours on at least one side. A full search of the epipolar lines keeps
/// only candidates that an edge of another image may confirm; following a lead, i.e. the candidate
/// of a neighbouring token, along its chain costs much less and finds most of them.
class CandidateSearch
{
public:
  /// Candidates of different images whose disparities differ by more than this number of
  /// tolerances have nothing to do with each other. Those that differ by more than one tolerance do
  /// not confirm each other, but they may do so at a neighbouring token of the chain.
  static constexpr double Promising = 2;

  /// Keeps references to the reference image and the options.
  CandidateSearch(const ImageEdges& reference, const std::vector<ImageEdges>& others,
    const MatcherOptions& options);

  std::size_t NumberOfImages() const { return this->Images.size(); } ///< without the reference
  std::size_t NumberOfTokens(std::size_t image) const { return this->Images[image].numberOfTokens; }

  /// The longest of all pairs, see EpipolarPair.
  double LongestBaseline() const { return this->Baseline; }

  /// Computes the epipolar lines of the tokens begin .. end - 1, which belong to one chain.
  void FindRays(int begin, int end);

  /// Selects one of these tokens and returns the number of images in which it can be searched for.
  int FindLines(int token);

  /// Whether the selected token can be searched for in an image: its epipolar line is in front of
  /// the camera and not too close to parallel to the edge.
  bool IsUsable(std::size_t image) const { return this->Lines[image].usable; }

  /// Adds a candidate of a neighbouring token as a lead, unless one of the leads follows the same
  /// edge.
  void AddLead(const EdgeCandidate& candidate);
  void ClearLeads() { this->Leads.clear(); }

  /// Adds the candidates of the selected token to which the leads lead.
  void FollowLeads(int token);

  /// Adds the candidates on the epipolar lines of the selected token, except in images to skip.
  void FindCandidates(int token, const std::vector<char>& skip);

  /// The candidates of the selected token.
  std::vector<EdgeCandidate> Candidates;

private:
  // Another image, ready to be searched.
  struct SearchImage
  {
    SearchImage(const ImageEdges& reference, const ColorStatistics& referenceColors,
      const ImageEdges& other, double minimumSine);

    // Prefetches what a candidate is compared by.
    void Prefetch(int token) const
    {
      FREESPACE_PREFETCH(&this->index.PieceOf(token));
      this->colors.Prefetch(token);
    }

    EpipolarPair pair;
    EpipolarIndex index;
    SideColors colors;
    std::size_t numberOfTokens;
  };

  // The epipolar line of a token in another image.
  struct EpipolarLine
  {
    EpipolarPair::Ray ray;
    Eigen::Vector2f tangent; // of the edge, rectified
    Eigen::Vector2f across;  // motion of the rectified pixel when the token moves one pixel across
    bool usable;             // in front of the camera, the edge not too close to parallel
  };

  // A point where an edge of another image crosses the epipolar line of a token.
  struct Crossing
  {
    float place;  // its disparity, pixels of the longest baseline
    float reach;  // maximum distance to one that it can confirm, in the same pixels
    float u;      // rectified column
    float cosine; // of the angle between both edges
    int image;
    int token;
  };

  float Reach(float sigma) const;
  void FindCrossings(int image);
  void Follow(int token, const EdgeCandidate& candidate);
  bool IsCandidate(int image, int token) const;
  void AddCandidate(int token, int image, int other, float u, float cosine);
  float CompareTokens(
    int token, const SideColors& colors, int other, bool crossed, float alignment) const;

  const EdgeChains& Edges; // of the reference
  const MatcherOptions& Options;
  double MinimumSine;
  double MinimumCosine;
  ColorStatistics Statistics; // of the reference
  SideColors Colors;          // of the reference
  std::vector<SearchImage> Images;
  double Baseline = 0; // the longest one

  // Of a chain.
  std::vector<EpipolarRays> Rays; // per image
  int FirstRay = 0;               // the token where it begins

  // Of the selected token.
  std::vector<EpipolarLine> Lines; // per image
  std::vector<EdgeCandidate> Leads;
  std::vector<Crossing> Crossings;
  ProximityBins Meetings;
};

}

#endif
