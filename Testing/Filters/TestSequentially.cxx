// SPDX-License-Identifier: BSD-3-Clause
#include "Execution/Sequentially.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

TEST(Sequentially, LeavesTheBackendAsItWasWhenSeveralThreadsUseIt)
{
  const std::string before = vtkSMPTools::GetBackend();
  std::vector<std::thread> threads;
  std::vector<std::string> within(8);
  for (std::string& backend : within)
  {
    threads.emplace_back(
      [&backend]
      {
        for (int k = 0; k < 50; ++k)
        {
          freespace::Sequentially(
            [&backend]
            {
              freespace::Sequentially([] {});
              backend = vtkSMPTools::GetBackend();
              std::this_thread::yield();
            });
        }
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_EQ(within, std::vector<std::string>(within.size(), "Sequential"));
  EXPECT_EQ(vtkSMPTools::GetBackend(), before);
}
