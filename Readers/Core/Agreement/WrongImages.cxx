// SPDX-License-Identifier: BSD-3-Clause
#include "Agreement/WrongImages.h"

#include "Agreement/ChanceMatches.h"
#include "Agreement/ImageAgreement.h"
#include "Agreement/RemainingImages.h"
#include "Common/Error.h"
#include "Refinement/RefinementClusters.h"
#include "Refinement/TrackBytes.h"
#include "Sharing/MakeAll.h"
#include "Stereo/ClusterMatching.h"

#include <algorithm>
#include <map>
#include <set>

namespace freespace
{

namespace
{

ImageAgreement AgreementOf(const ClusterMatches& found)
{
  ImageAgreement agreement;
  agreement.image = found.referenceImage;
  agreement.tokens = static_cast<double>(found.matches.size());
  for (const int other : found.otherImages)
  {
    agreement.others.emplace_back(other, 0);
  }
  for (const EdgeMatch& match : found.matches)
  {
    if (match.images < 2)
    {
      continue;
    }
    ++agreement.confirmed;
    std::set<int> shown;
    for (int k = match.support; k < match.support + match.images; ++k)
    {
      shown.insert(found.support[k].image);
    }
    for (const int other : shown)
    {
      ++agreement.others[other].second;
    }
  }
  return agreement;
}

struct MeasuredCluster
{
  ImageAgreement agreement;
  std::vector<EdgeTrack> tracks;
};

template <typename Bytes>
void Exchange(Bytes& bytes, MeasuredCluster& measured)
{
  ImageAgreement& agreement = measured.agreement;
  bytes(agreement.image, agreement.tokens, agreement.confirmed, agreement.others, measured.tracks);
}

// Matches clusters around all images of a model, but those that were matched in the same company before.
class AgreementMeter
{
public:
  AgreementMeter(EdgeStore& edges, const std::vector<CalibratedImage>& images,
    const MatcherOptions& matching, const WrongImageOptions& options, ClusterTracks* tracks)
    : Edges(edges)
    , Images(images)
    , Matching(matching)
    , Options(options)
    , Tracks(tracks)
  {
    this->Matching.tolerance = options.matching.tolerance;
  }

  std::vector<ImageAgreement> Measure(
    const std::vector<Cluster>& clusters, const ParallelFor& parallelFor, const Progress& progress)
  {
    std::vector<const Cluster*> unknown;
    for (const Cluster& cluster : clusters)
    {
      if (this->Known.count(cluster.triplets) == 0)
      {
        unknown.push_back(&cluster);
      }
    }
    std::vector<MeasuredCluster> found =
      MakeAll<MeasuredCluster>(unknown.size(), parallelFor, progress,
        [&](std::size_t i, const CancellationFlag& stop)
        {
          const ClusterMatches matches = this->Match(this->Images, *unknown[i], stop);
          MeasuredCluster measured{ AgreementOf(matches), {} };
          if (this->Tracks)
          {
            measured.tracks =
              TracksOfCluster(matches, this->Options.matching.TracksOfEach(this->Images.size()));
          }
          return measured;
        });
    for (std::size_t i = 0; i < unknown.size(); ++i)
    {
      this->Known[unknown[i]->triplets] = found[i].agreement;
      if (this->Tracks)
      {
        (*this->Tracks)[unknown[i]->triplets] = std::move(found[i].tracks);
      }
    }
    std::vector<ImageAgreement> all;
    for (const Cluster& cluster : clusters)
    {
      all.push_back(this->Known.at(cluster.triplets));
    }
    return all;
  }

  // Whether the reference of a cluster that was measured has more than chance gives it.
  bool ExceedsChance(const Cluster& cluster, const CancellationFlag& stop)
  {
    return freespace::ExceedsChance(this->Images, cluster, this->Known.at(cluster.triplets),
      [&](const std::vector<CalibratedImage>& images, const Cluster& given)
      { return AgreementOf(this->Match(images, given, stop)); });
  }

private:
  ClusterMatches Match(const std::vector<CalibratedImage>& images, const Cluster& cluster,
    const CancellationFlag& stop) const
  {
    return MatchCluster(
      this->Edges, images, cluster, this->Matching, this->Options.matching.tokensPerImage, stop);
  }

  EdgeStore& Edges;
  const std::vector<CalibratedImage>& Images;
  MatcherOptions Matching;
  const WrongImageOptions& Options;
  ClusterTracks* Tracks;
  std::map<decltype(Cluster::triplets), ImageAgreement> Known;
};

// Removes the images that form a group of their own, apart from the others: few of their edges are confirmed, because
// their neighbours are far or the light is poor, but more than by chance, and they confirm each other.
void KeepCoherentGroups(std::vector<std::string>& wrong, const std::vector<Cluster>& clusters,
  const std::vector<CalibratedImage>& images, AgreementMeter& meter, const ParallelFor& parallelFor,
  const Progress& progress)
{
  const std::vector<ImageAgreement> all =
    meter.Measure(clusters, parallelFor, progress.Part(0, 0.5));
  const auto isWrong = [&](int image)
  {
    const std::string& file = images[static_cast<std::size_t>(image)].file;
    return std::find(wrong.begin(), wrong.end(), file) != wrong.end();
  };
  const std::vector<char> exceeds = MakeAll<char>(all.size(), parallelFor, progress.Part(0.5, 1),
    [&](std::size_t i, const CancellationFlag& stop)
    { return isWrong(all[i].image) && meter.ExceedsChance(clusters[i], stop); });
  std::vector<ImageAgreement> candidates;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (exceeds[i])
    {
      candidates.push_back(all[i]);
    }
  }
  for (const int image : ConfirmedByEachOther(candidates))
  {
    const std::string& file = images[static_cast<std::size_t>(image)].file;
    wrong.erase(std::remove(wrong.begin(), wrong.end(), file), wrong.end());
  }
}

}

void WrongImageOptions::Check() const
{
  this->matching.Check();
  if (this->rounds < 1)
  {
    throw Error("Looking for wrong images takes one round at least.");
  }
}

std::vector<std::string> FindWrongImages(const Scene& scene, const SparseModel& model,
  EdgeStore& edges, const MatcherOptions& matching, const WrongImageOptions& options,
  const ParallelFor& parallelFor, const Progress& progress, ClusterTracks* tracks)
{
  options.Check();
  const std::vector<CalibratedImage> images = CalibratedImages(model);
  AgreementMeter meter(edges, images, matching, options, tracks);
  const auto judge = [&](const std::set<std::string>& without, const Progress& part)
  {
    const auto clusters = ClustersForRefinement(
      WithoutImages(scene, without), WithoutImages(model, without), options.matching.neighbors);
    return FindAgreement(images.size(), meter.Measure(clusters, parallelFor, part));
  };
  std::set<std::string> suspects;
  for (int round = 0; round < options.rounds; ++round)
  {
    const double begin = 0.5 * round / options.rounds;
    const Agreement found = judge(suspects, progress.Part(begin, begin + 0.5 / options.rounds));
    if (found.contradicted.empty())
    {
      break;
    }
    for (const int image : found.contradicted)
    {
      suspects.insert(images[static_cast<std::size_t>(image)].file);
    }
  }
  // A right one among wrong ones is suspected with them. It agrees with the others once these are gone.
  std::vector<std::string> wrong;
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    std::set<std::string> without = suspects;
    if (without.erase(images[i].file) > 0)
    {
      const Agreement found = judge(
        without, progress.Part(0.5 + 0.4 * i / images.size(), 0.5 + 0.4 * (i + 1) / images.size()));
      const std::vector<int>& confirmed = found.confirmed;
      if (std::binary_search(confirmed.begin(), confirmed.end(), static_cast<int>(i)))
      {
        suspects.erase(images[i].file);
      }
      else
      {
        wrong.push_back(images[i].file);
      }
    }
  }
  if (wrong.size() > 2)
  {
    KeepCoherentGroups(wrong, ClustersForRefinement(scene, model, options.matching.neighbors),
      images, meter, parallelFor, progress.Part(0.9, 1));
  }
  progress(1);
  return wrong;
}

}
