#pragma once

#include "reproduce/finding.h"
#include "reproduce/workbench.h"

namespace penumbra::reproduce {

// Each function makes our version of one figure of the thesis. The workbench draws the pictures when they are first
// needed.
using MakeFigure = Finding (*)(Workbench& bench);

// What chapter 2 says of other techniques and of histories, without a figure.
Finding section_2_2(Workbench& bench);
Finding section_2_3(Workbench& bench);
Finding section_2_5(Workbench& bench);

// Points and noise: no scene.
Finding figure_2_8(Workbench& bench);
Finding figure_2_9(Workbench& bench);
Finding figure_2_10(Workbench& bench);
Finding figure_2_11(Workbench& bench);
Finding figure_2_12(Workbench& bench);
Finding figure_2_13(Workbench& bench);
Finding figure_2_14(Workbench& bench);

// The reference scene.
Finding figure_4_1(Workbench& bench);
Finding figure_4_2(Workbench& bench);
Finding figure_4_3(Workbench& bench);
Finding figure_4_4(Workbench& bench);
Finding figure_4_5(Workbench& bench);
Finding figure_4_6(Workbench& bench);
Finding figure_4_7(Workbench& bench);
Finding figure_4_8(Workbench& bench);
Finding figure_4_9(Workbench& bench);
Finding figure_4_10(Workbench& bench);
Finding figure_4_11(Workbench& bench);
Finding figure_4_12(Workbench& bench);
Finding figure_4_13(Workbench& bench);

}  // namespace penumbra::reproduce
