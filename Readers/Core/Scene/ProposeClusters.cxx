// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/ProposeClusters.h"

#include "Common/Error.h"
#include "Scene/ImageNeighborhoods.h"
#include "Scene/ReferenceChoice.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <unordered_map>

namespace freespace
{

namespace
{

// Weight of a triplet whose neighbours are not on opposite sides of the reference.
constexpr double Bent = 0.3;

// Minimum gain of a second triplet, as a fraction of the quality of the first.
constexpr double LeastGain = 0.1;

// Minimum quality of a second triplet along the first, as a fraction of that of the first.
constexpr double LeastAlong = 0.3;

// The two images of a triplet as the reference sees them.
struct Pair
{
  ProposedTriplet triplet;
  Eigen::Vector2d direction = Eigen::Vector2d::Zero(); // from the first to the second, of length 1
  double angle = 0;                                    // mean, radians
};

Pair MakePair(const Neighbor& a, const Neighbor& b)
{
  const Eigen::Vector2d across = (a.distance * a.direction - b.distance * b.direction).normalized();
  const bool horizontal = std::abs(across.x()) >= std::abs(across.y());
  const bool inOrder = (horizontal ? across.x() : across.y()) < 0;
  const Neighbor& first = inOrder ? a : b;
  const Neighbor& second = inOrder ? b : a;
  Pair pair;
  pair.triplet.neighbors = { first.image, second.image };
  pair.triplet.angle = { first.angle / degree, second.angle / degree };
  pair.triplet.overlap = { first.overlap, second.overlap };
  pair.triplet.quality = std::sqrt(a.quality * b.quality);
  pair.direction = inOrder ? Eigen::Vector2d(-across) : across;
  pair.angle = 0.5 * (a.angle + b.angle);
  return pair;
}

// The pairs of neighbours that a reference can be matched with, the better the more they stand on
// opposite sides and as far away. Of two on one side, one must be much farther than the other.
std::vector<Pair> PairsOf(const std::vector<Neighbor>& neighbors)
{
  const double oneSide = std::cos(30 * degree);
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < neighbors.size(); ++i)
  {
    for (std::size_t j = i + 1; j < neighbors.size(); ++j)
    {
      const Neighbor &a = neighbors[i], &b = neighbors[j];
      const double straight = -a.direction.dot(b.direction);
      const double balance = std::min(a.distance, b.distance) / std::max(a.distance, b.distance);
      if (-straight < oneSide || balance < 0.75)
      {
        pairs.push_back(MakePair(a, b));
        pairs.back().triplet.quality *=
          straight > 0 ? (Bent + (1 - Bent) * straight) * std::sqrt(balance) : Bent;
      }
    }
  }
  return pairs;
}

bool AreDisjoint(const ProposedTriplet& a, const ProposedTriplet& b)
{
  return a.neighbors[0] != b.neighbors[0] && a.neighbors[0] != b.neighbors[1] &&
    a.neighbors[1] != b.neighbors[0] && a.neighbors[1] != b.neighbors[1];
}

// Of a second triplet's quality, how much is new beside a first one: all when it is perpendicular and
// so sees the edges that the first one cannot; a good part when it is along it and has another length.
double Novelty(const Pair& first, const Pair& second)
{
  const double cosine = first.direction.dot(second.direction);
  if (std::abs(cosine) < std::cos(45 * degree))
  {
    return 1 - cosine * cosine;
  }
  const double ratio = std::log(second.angle / first.angle) / std::log(1.6);
  return second.triplet.quality < LeastAlong * first.triplet.quality
    ? 0
    : 0.5 * (1 - std::exp(-ratio * ratio));
}

ProposedCluster BestCluster(std::size_t reference, const std::vector<Pair>& pairs, int neighbors)
{
  ProposedCluster best;
  best.reference = static_cast<int>(reference);
  for (const Pair& first : pairs)
  {
    if (first.triplet.quality > best.quality)
    {
      best.triplets = { first.triplet };
      best.quality = first.triplet.quality;
      best.cross = false;
    }
    for (const Pair& second : pairs)
    {
      if (neighbors < 4 || second.triplet.quality > first.triplet.quality ||
        !AreDisjoint(first.triplet, second.triplet))
      {
        continue;
      }
      const double gain = second.triplet.quality * Novelty(first, second);
      if (gain > LeastGain * first.triplet.quality && first.triplet.quality + gain > best.quality)
      {
        best.triplets = { first.triplet, second.triplet };
        best.quality = first.triplet.quality + gain;
        best.cross = std::abs(first.direction.dot(second.direction)) < std::cos(45 * degree);
      }
    }
  }
  return best;
}

// Without its folder and extension.
std::string Stem(const std::string& image)
{
  return std::filesystem::path(image).stem().string();
}

std::string Count(std::size_t count, const std::string& one, const std::string& several)
{
  return std::to_string(count) + " " + (count == 1 ? one : several);
}

}

void ClusterProposalOptions::Check() const
{
  if (!(this->minimumAngle > 0 && this->minimumAngle <= this->preferredAngle &&
        this->preferredAngle <= this->maximumAngle && this->maximumAngle < 90))
  {
    throw Error("The angles of neighbours must be positive and below 90 degrees, the preferred one "
                "between the least and the greatest.");
  }
  if (!(this->minimumOverlap >= 0 && this->minimumOverlap <= 1))
  {
    throw Error("The overlap of neighbours must be in [0, 1].");
  }
  if (this->neighbors != 2 && this->neighbors != 4)
  {
    throw Error("A reference has 2 or 4 neighbours.");
  }
  if (!(this->separation >= 0 && this->separation < 90))
  {
    throw Error("The separation of references must be at least 0 and below 90 degrees.");
  }
  if (!(this->coverage >= 0 && this->smallSet >= 0) ||
    !(this->coverageAngle > 0 && this->coverageAngle < 90))
  {
    throw Error("The coverage by references must be at least 0, its angle positive and below 90 "
                "degrees.");
  }
}

ClusterProposal ProposeClusters(const SparseModel& model, const ClusterProposalOptions& options)
{
  options.Check();
  const ImageNeighborhoods images(model, options);
  std::vector<ProposedCluster> clusters(images.Size());
  std::vector<PossibleReference> possible;
  ClusterProposal proposal;
  for (std::size_t i = 0; i < images.Size(); ++i)
  {
    clusters[i] = BestCluster(i, PairsOf(images.NeighborsOf(i)), options.neighbors);
    if (clusters[i].triplets.empty())
    {
      proposal.alone.push_back(static_cast<int>(i));
    }
    else
    {
      possible.push_back({ static_cast<int>(i), clusters[i].quality });
    }
  }
  std::vector<bool> isReference(images.Size(), false);
  for (int reference : ChooseReferences(images, possible, options))
  {
    isReference[static_cast<std::size_t>(reference)] = true;
    proposal.clusters.push_back(std::move(clusters[static_cast<std::size_t>(reference)]));
  }
  for (const PossibleReference& reference : possible)
  {
    if (!isReference[static_cast<std::size_t>(reference.image)])
    {
      proposal.spare.push_back(reference.image);
    }
  }
  return proposal;
}

std::vector<Cluster> ClustersFromProposal(
  const SparseModel& model, const std::vector<ProposedCluster>& proposal)
{
  const auto name = [&](int image) { return model.images[static_cast<std::size_t>(image)].name; };
  std::unordered_map<std::string, int> uses;
  for (const ProposedCluster& proposed : proposal)
  {
    ++uses[Stem(name(proposed.reference))];
  }
  std::vector<Cluster> clusters;
  for (const ProposedCluster& proposed : proposal)
  {
    Cluster& cluster = clusters.emplace_back();
    cluster.reference = name(proposed.reference);
    cluster.name = Stem(cluster.reference);
    if (uses[cluster.name] > 1) // in several folders
    {
      cluster.name = cluster.reference;
      std::replace(cluster.name.begin(), cluster.name.end(), '/', '_');
    }
    for (const ProposedTriplet& triplet : proposed.triplets)
    {
      cluster.triplets.push_back(
        { name(triplet.neighbors[0]), cluster.reference, name(triplet.neighbors[1]) });
    }
  }
  return clusters;
}

std::string DescribeClusters(const SparseModel& model, const std::vector<ProposedCluster>& proposal)
{
  const auto name = [&](int image) { return model.images[static_cast<std::size_t>(image)].name; };
  std::string text;
  for (const ProposedCluster& cluster : proposal)
  {
    text += name(cluster.reference) + (cluster.cross ? ": cross" : ": row") + "\n";
    for (const ProposedTriplet& triplet : cluster.triplets)
    {
      char figures[100];
      std::snprintf(figures, sizeof(figures), "%.1f and %.1f degrees, overlap %.2f and %.2f",
        triplet.angle[0], triplet.angle[1], triplet.overlap[0], triplet.overlap[1]);
      text += "  " + name(triplet.neighbors[0]) + " | " + name(triplet.neighbors[1]) + "  " +
        figures + "\n";
    }
  }
  return text;
}

std::string DescribeChoice(const SparseModel& model, const ClusterProposal& proposal)
{
  std::string text = std::to_string(proposal.clusters.size()) + " of " +
    Count(model.images.size(), "image is a reference", "images are references");
  if (!proposal.spare.empty())
  {
    text += "; " + Count(proposal.spare.size(), "sees", "see") + " what these see";
  }
  if (!proposal.alone.empty())
  {
    constexpr std::size_t most = 10;
    text += "; " + Count(proposal.alone.size(), "has", "have") + " no partner: ";
    for (std::size_t i = 0; i < std::min(most, proposal.alone.size()); ++i)
    {
      text += (i > 0 ? ", " : "") + model.images[static_cast<std::size_t>(proposal.alone[i])].name;
    }
    text += proposal.alone.size() > most ? ", ..." : "";
  }
  return text;
}

}
