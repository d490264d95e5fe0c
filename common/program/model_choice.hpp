// Which model a scene needs: the sentence, from what two or more of them were measured to do.
#pragma once

#include <string>
#include <vector>

namespace talus::program {

/// A richer model of a scene beside the poorest one that may do.
struct RicherModel {
  std::string name;
  double apart = 0;                        ///< largest distance of the two answers, relative
  double times_cpu = 1, times_memory = 1;  ///< what it took, in that of the poorer one
};

/// Decimal digits in which two answers at this relative distance agree: 0 to 16.
int digits(double apart);

/// "For the chute use 1D, because ...": the poorer model if all richer ones agree with it to
/// `needed` digits, else the first richer one that does not. `richer` from poor to rich, not empty.
std::string recommendation(const std::string& scene, const std::string& poorer,
                           const std::vector<RicherModel>& richer, int needed = 9);

/// A hint, never a refusal, for who asks for a richer model than the scene needs: one line that
/// names the poorer one and how to ask for it.
std::string hint_of_poorer_model(const std::string& scene, const std::string& asked_for,
                                 const std::string& poorer, const std::string& how_to_ask);

}  // namespace talus::program
