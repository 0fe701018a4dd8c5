// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Commands_h
#define freespace_Commands_h

#include <CLI/CLI.hpp>

namespace freespace
{

class Session;

/// Each adds one command of the program, with its options, help and action.
void AddReconstructCommand(CLI::App& program, Session& session);
void AddSparseCommand(CLI::App& program, Session& session);
void AddDepthCommand(CLI::App& program, Session& session);
void AddCalibrateCommand(CLI::App& program, Session& session);
void AddClustersCommand(CLI::App& program, Session& session);
void AddRefineCommand(CLI::App& program, Session& session);
void AddStereoCommand(CLI::App& program, Session& session);
void AddTriangulateCommand(CLI::App& program, Session& session);
void AddContourCommand(CLI::App& program, Session& session);
void AddCompareCommand(CLI::App& program, Session& session);
void AddExportCommand(CLI::App& program, Session& session);
void AddInfoCommand(CLI::App& program, Session& session);
void AddMeshCommand(CLI::App& program, Session& session);
void AddQueryCommand(CLI::App& program, Session& session);
void AddRenderCommand(CLI::App& program, Session& session);
void AddTextureCommand(CLI::App& program, Session& session);
void AddOccupancyCommand(CLI::App& program, Session& session);
void AddReportCommand(CLI::App& program, Session& session);
void AddViewCommand(CLI::App& program, Session& session);
void AddRunCommand(CLI::App& program, Session& session);

}

#endif
