/*
 * What FMI 3 has and this FMU has not: other kinds of variables, other interfaces, clocks.
 */
FMI3_NONE(fmi3EnterStepMode) FMI3_NONE(fmi3EnterConfigurationMode) FMI3_NONE(fmi3ExitConfigurationMode)
FMI3_NONE(fmi3GetOutputDerivatives) FMI3_NONE(fmi3ActivateModelPartition)
FMI3_NONE(fmi3GetNumberOfVariableDependencies) FMI3_NONE(fmi3GetVariableDependencies)
FMI3_NONE(fmi3GetAdjointDerivative) FMI3_NONE(fmi3EvaluateDiscreteStates) FMI3_NONE(fmi3GetFloat32)
FMI3_NONE(fmi3GetInt8) FMI3_NONE(fmi3GetUInt8) FMI3_NONE(fmi3GetInt16) FMI3_NONE(fmi3GetUInt16)
FMI3_NONE(fmi3GetInt32) FMI3_NONE(fmi3GetUInt32) FMI3_NONE(fmi3GetInt64) FMI3_NONE(fmi3GetUInt64)
FMI3_NONE(fmi3GetBoolean) FMI3_NONE(fmi3GetString) FMI3_NONE(fmi3GetBinary) FMI3_NONE(fmi3GetClock)
FMI3_NONE(fmi3SetFloat32) FMI3_NONE(fmi3SetInt8) FMI3_NONE(fmi3SetUInt8) FMI3_NONE(fmi3SetInt16)
FMI3_NONE(fmi3SetUInt16) FMI3_NONE(fmi3SetInt32) FMI3_NONE(fmi3SetUInt32) FMI3_NONE(fmi3SetInt64)
FMI3_NONE(fmi3SetUInt64) FMI3_NONE(fmi3SetBoolean) FMI3_NONE(fmi3SetString) FMI3_NONE(fmi3SetBinary)
FMI3_NONE(fmi3SetClock) FMI3_NONE(fmi3GetIntervalDecimal) FMI3_NONE(fmi3GetIntervalFraction)
FMI3_NONE(fmi3GetShiftDecimal) FMI3_NONE(fmi3GetShiftFraction) FMI3_NONE(fmi3SetIntervalDecimal)
FMI3_NONE(fmi3SetIntervalFraction) FMI3_NONE(fmi3SetShiftDecimal) FMI3_NONE(fmi3SetShiftFraction)
